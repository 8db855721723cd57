#include "set/manifest.h"

#include <algorithm>

#include "base/files.h"
#include "base/json_object.h"
#include "base/json_text.h"
#include "base/lists.h"
#include "gloam/error.h"
#include "set/sha256.h"

namespace gloam::sets {
namespace {

using Json = nlohmann::ordered_json;

bool is_item_name(const std::string& name) {
  return !name.empty() && std::all_of(name.begin(), name.end(), [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= '0' && c <= '9') || c == '-';
  });
}

/// A file inside the set's folder: a manifest of anybody must not name others.
bool is_inside(const std::string& file) {
  const std::filesystem::path path(file);
  return !file.empty() && path.is_relative() && std::none_of(path.begin(), path.end(), [](const auto& part) {
    return part.empty() || part == "." || part == "..";
  });
}

std::vector<SetFile> files_of(const JsonObject& fields, size_t count) {
  std::vector<SetFile> files;
  for (const JsonObject& one : fields.objects("files")) {
    SetFile file{one.text("file"), one.text("sha256")};
    if (!is_inside(file.file)) one.refuse("file", "it must be a path inside the set's folder, without . and ..");
    if (!is_sha256(file.sha256)) one.refuse("sha256", "it must be 64 hexadecimal digits in lower case");
    files.push_back(std::move(file));
  }
  if (files.size() != count)
    fields.refuse("files", fmt::format("there must be {}, one for each frame, and there are {}", count, files.size()));
  return files;
}

SetTruth truth_of(const JsonObject& fields, size_t frames) {
  SetTruth truth;
  truth.effect = fields.text("effect");
  truth.rays = fields.whole("rays");
  truth.noise = fields.number("noise");
  if (truth.noise < 0) fields.refuse("noise", "0 and more are allowed");
  truth.best_error = fields.number_if("best_error");
  truth.files = files_of(fields, frames);
  return truth;
}

SetItem item_of(const JsonObject& fields) {
  SetItem item;
  item.name = fields.text("name");
  if (!is_item_name(item.name)) fields.refuse("name", "small letters, digits and - are allowed");
  item.kind = fields.text("kind");
  if (!contains(item_kinds(), item.kind)) fields.refuse("kind", "there are " + enumerate(item_kinds()));
  item.scene_class = fields.text("class");
  const std::vector<int> size = fields.wholes("size", 1, 1 << 16);
  if (size.size() != 2) fields.refuse("size", "it must be [width, height]");
  item.width = size[0], item.height = size[1];
  item.views = fields.texts("views");
  if (fields.find("frames")) item.frames = fields.wholes("frames");
  if ((item.kind == "sequence") == item.frames.empty())
    fields.refuse("frames", "a sequence has a list of numbers, other items have none");
  item.radius = fields.number("radius");
  if (!(item.radius > 0)) fields.refuse("radius", "more than 0 is allowed");
  item.licence = fields.text("licence");
  const size_t frames = std::max<size_t>(item.frames.size(), 1);
  item.files = files_of(fields, frames);
  for (const JsonObject& one : fields.objects("truths")) {
    item.truths.push_back(truth_of(one, frames));
    for (size_t i = 0; i + 1 < item.truths.size(); ++i) {
      if (item.truths[i].effect == item.truths.back().effect) one.refuse("effect", "it has one truth already");
    }
  }
  return item;
}

Json document_of(const std::vector<SetFile>& files) {
  Json list = Json::array();
  for (const SetFile& file : files) list.push_back({{"file", file.file}, {"sha256", file.sha256}});
  return list;
}

Json document_of(const SetTruth& truth) {
  return {{"effect", truth.effect},
          {"rays", truth.rays},
          {"noise", truth.noise},
          {"best_error", or_null(truth.best_error)},
          {"files", document_of(truth.files)}};
}

Json document_of(const SetItem& item) {
  Json document = {{"name", item.name},
                   {"kind", item.kind},
                   {"class", item.scene_class},
                   {"size", {item.width, item.height}},
                   {"views", item.views}};
  if (!item.frames.empty()) document["frames"] = item.frames;
  document["radius"] = item.radius;
  document["licence"] = item.licence;
  document["files"] = document_of(item.files);
  document["truths"] = Json::array();
  for (const SetTruth& truth : item.truths) document["truths"].push_back(document_of(truth));
  return document;
}

std::string lines_of(const std::vector<SetFile>& files) {
  std::string lines;
  for (const SetFile& file : files) lines += file.file + " " + file.sha256 + "\n";
  return lines;
}

}  // namespace

const std::vector<std::string>& item_kinds() {
  static const std::vector<std::string> kinds = {"frame", "sequence", "eyes", "display", "hard"};
  return kinds;
}

Manifest manifest_of(const std::string& text, const std::string& name) {
  const Json document = json_of_text(text, name);
  const JsonObject fields(document, {name});
  Manifest manifest;
  manifest.set = fields.text("set");
  manifest.part = fields.text("part");
  if (manifest.part != "public" && manifest.part != "seeded") fields.refuse("part", "there are public and seeded");
  if (fields.find("seed")) {
    if (!fields.find("seed")->is_number_unsigned()) fields.refuse("seed", "whole numbers from 0 are allowed");
    manifest.seed = fields.find("seed")->get<uint64_t>();
  }
  if ((manifest.part == "seeded") != manifest.seed.has_value())
    fields.refuse("seed", "a seeded part has one, and a public part null");
  manifest.gloam = fields.text("gloam");
  manifest.commit = fields.text("commit");
  manifest.licence = fields.text("licence");
  manifest.hash = fields.text("hash");
  for (const JsonObject& one : fields.objects("items")) {
    SetItem item = item_of(one);
    if (find_item(manifest, item.name)) one.refuse("name", "an item before it has that name");
    manifest.items.push_back(std::move(item));
  }
  const std::string hash = hash_of(manifest.items);
  if (manifest.hash != hash)
    fields.refuse("hash", fmt::format("its items give {}: the manifest was changed by hand; make the set again", hash));
  return manifest;
}

Manifest read_manifest(const std::filesystem::path& folder) {
  const std::filesystem::path path = folder / "manifest.json";
  std::error_code unknown;
  if (!std::filesystem::exists(path, unknown))
    throw Error("{}: there is no set: no manifest.json; gloam set make NAME -o DIR makes one", folder.string());
  check_regular(path);
  return manifest_of(read_text(path), path.string());
}

std::string text_of(const Manifest& manifest) {
  Json document = {{"set", manifest.set},
                   {"part", manifest.part},
                   {"seed", manifest.seed ? Json(*manifest.seed) : Json()},
                   {"gloam", manifest.gloam},
                   {"commit", manifest.commit},
                   {"licence", manifest.licence},
                   {"hash", hash_of(manifest.items)},
                   {"items", Json::array()}};
  for (const SetItem& item : manifest.items) document["items"].push_back(document_of(item));
  return document.dump(2) + "\n";
}

void write_manifest(const std::filesystem::path& folder, const Manifest& manifest) {
  write_text(folder / "manifest.json", text_of(manifest));
}

std::string hash_of(const SetItem& item) {
  std::string text = fmt::format("{} {} {} {}x{} radius {}\n", item.name, item.kind, item.scene_class, item.width,
                                 item.height, item.radius);
  for (const std::string& view : item.views) text += "view " + view + "\n";
  for (const int frame : item.frames) text += fmt::format("frame {}\n", frame);
  text += lines_of(item.files);
  for (const SetTruth& truth : item.truths) text += truth.effect + "\n" + lines_of(truth.files);
  return sha256_of(text);
}

std::string hash_of(const std::vector<SetItem>& items) {
  Sha256 sum;
  for (const SetItem& item : items) sum.add(hash_of(item));
  return sum.digits();
}

std::vector<SetFile> files_of(const SetItem& item) {
  std::vector<SetFile> files = item.files;
  for (const SetTruth& truth : item.truths) files.insert(files.end(), truth.files.begin(), truth.files.end());
  return files;
}

const SetItem* find_item(const Manifest& manifest, const std::string& name) {
  for (const SetItem& item : manifest.items) {
    if (item.name == name) return &item;
  }
  return nullptr;
}

const SetTruth* find_truth(const SetItem& item, const std::string& effect) {
  for (const SetTruth& truth : item.truths) {
    if (truth.effect == effect) return &truth;
  }
  return nullptr;
}

}  // namespace gloam::sets
