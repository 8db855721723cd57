#include "scene/assimp_files.h"

#include <assimp/MemoryIOWrapper.h>

#include <algorithm>
#include <assimp/IOStream.hpp>
#include <cctype>
#include <cstddef>
#include <fstream>
#include <memory>
#include <optional>
#include <set>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include "base/file_ledger.h"
#include "base/files.h"
#include "base/words.h"
#include "gloam/error.h"
#include "scene/import_materials.h"

namespace gloam {
namespace {

struct ObjText {
  std::string text;
  size_t faces = 0;  ///< of three vertices and more
};

struct MtlText {
  std::string text;
  std::vector<std::string> left_out;  ///< statements whose value is no number: "Kd spectral"
};

bool is_space(char c) { return c == ' ' || c == '\t' || c == '\r' || c == '\f' || c == '\v'; }

std::vector<std::string_view> words_of(std::string_view line) {
  std::vector<std::string_view> words;
  for (size_t at = 0; at < line.size();) {
    while (at < line.size() && is_space(line[at])) ++at;
    const size_t from = at;
    while (at < line.size() && !is_space(line[at])) ++at;
    if (at > from) words.push_back(line.substr(from, at - from));
  }
  return words;
}

size_t digits_at(std::string_view text, size_t from) {
  size_t at = from;
  while (at < text.size() && std::isdigit(static_cast<unsigned char>(text[at]))) ++at;
  return at - from;
}

/// "-.5" as "-0.5", "+5." as "5.0", "nan" as a number beyond float; none if it is not a number.
std::optional<std::string> as_number(std::string_view word) {
  std::string sign;
  if (!word.empty() && (word[0] == '-' || word[0] == '+')) {
    if (word[0] == '-') sign = "-";
    word.remove_prefix(1);
  }
  const std::string small = lower(word);
  if (small.starts_with("nan") || small.starts_with("inf") || small.starts_with("1.#") || small.starts_with("-1.#"))
    return sign + "1e39";
  const size_t whole = digits_at(word, 0);
  size_t at = whole, fraction = 0;
  const bool has_point = at < word.size() && word[at] == '.';
  if (has_point) fraction = digits_at(word, at + 1), at += 1 + fraction;
  if (whole + fraction == 0) return {};
  std::string number = sign + (whole ? std::string(word.substr(0, whole)) : "0");
  if (has_point) number += "." + (fraction ? std::string(word.substr(whole + 1, fraction)) : "0");
  if (at == word.size()) return number;
  if (word[at] != 'e' && word[at] != 'E') return {};
  const size_t digits_from = at + 1 + (at + 1 < word.size() && (word[at + 1] == '-' || word[at + 1] == '+'));
  const size_t digits = digits_at(word, digits_from);
  if (digits == 0 || digits_from + digits != word.size()) return {};
  return number + std::string(word.substr(at));
}

/// A line that ends in a backslash goes on in the next.
class Lines {
 public:
  explicit Lines(const std::string& text) : text_(text) {}
  bool next() {
    if (at_ >= text_.size()) return false;
    line_.clear();
    first_ = number_ + 1;
    for (bool goes_on = true; goes_on && at_ < text_.size();) {
      const size_t end = std::min(text_.find('\n', at_), text_.size());
      std::string_view piece = std::string_view(text_).substr(at_, end - at_);
      at_ = end + 1;
      ++number_;
      while (!piece.empty() && is_space(piece.back())) piece.remove_suffix(1);
      goes_on = !piece.empty() && piece.back() == '\\';
      if (goes_on) piece.remove_suffix(1);
      line_ += (line_.empty() ? "" : " ") + std::string(piece);
    }
    return true;
  }
  const std::string& line() const { return line_; }
  size_t number() const { return first_; }

 private:
  const std::string& text_;
  std::string line_;
  size_t at_ = 0, number_ = 0, first_ = 0;
};

/// Ignores words of a comment after the values.
std::string with_numbers(const std::vector<std::string_view>& words, const std::string& file, size_t line) {
  std::string result(words[0]);
  for (size_t i = 1; i < words.size() && words[i][0] != '#'; ++i) {
    const std::optional<std::string> number = as_number(words[i]);
    if (!number)
      throw Error("{}: line {}: '{}' of '{}' is no number", file, line, std::string(words[i]), std::string(words[0]));
    result += " " + *number;
  }
  return result;
}

/// The same geometry with every number in the form 0.5. Words such as nan become numbers that are not finite. Throws Error naming
/// `file` and the line if a word stands where a number must be.
ObjText readable_obj(const std::string& text, const std::string& file) {
  static const std::set<std::string_view> vectors = {"v", "vt", "vn"};
  ObjText result;
  result.text.reserve(text.size() + text.size() / 8);
  for (Lines lines(text); lines.next(); result.text += '\n') {
    const std::vector<std::string_view> words = words_of(lines.line());
    if (words.empty()) continue;
    if (words[0] == "f") result.faces += words.size() > 3;
    result.text += vectors.contains(words[0]) ? with_numbers(words, file, lines.number()) : lines.line();
  }
  return result;
}

/// The same materials, without statements that assimp mistakes for others (`aniso`, `d -halo`) or cannot read.
MtlText readable_mtl(const std::string& text) {
  static const std::set<std::string_view> numbers = {"Ka", "Kd", "Ks", "Ke", "Tf", "Tr", "d",
                                                     "Ns", "Ni", "Pr", "Pm", "Ps", "Pc", "Pcr"};
  MtlText result;
  for (Lines lines(text); lines.next(); result.text += '\n') {
    std::vector<std::string_view> words = words_of(lines.line());
    if (words.empty() || words[0].starts_with("a")) continue;  // "aniso", "anisor": assimp wants a number after the "a"
    if (!numbers.contains(words[0])) {
      result.text += lines.line();
      continue;
    }
    if (words.size() > 1 && words[1] == "-halo") words.erase(words.begin() + 1);
    std::string statement(words[0]);
    size_t values = 0;
    for (size_t i = 1; i < words.size(); ++i, ++values) {
      const std::optional<std::string> number = as_number(words[i]);
      if (!number) break;
      statement += " " + *number;
    }
    if (values > 0)
      result.text += statement;
    else
      result.left_out.push_back(std::string(words[0]) + (words.size() > 1 ? " " + std::string(words[1]) : ""));
  }
  return result;
}

namespace fs = std::filesystem;

/// A file that ends: some of assimp's readers (PLY) would read for ever if a file is cut short.
class EndingStream : public Assimp::IOStream {
 public:
  explicit EndingStream(Assimp::IOStream* from) : from_(from) {}
  size_t Read(void* to, size_t size, size_t count) override {
    const size_t n = from_->Read(to, size, count);
    if (n == 0 && count > 0 && ++reads_past_end_ > 1000) throw std::runtime_error("it ends too early");
    return n;
  }
  size_t Write(const void*, size_t, size_t) override { return 0; }
  aiReturn Seek(size_t offset, aiOrigin origin) override { return from_->Seek(offset, origin); }
  size_t Tell() const override { return from_->Tell(); }
  size_t FileSize() const override { return from_->FileSize(); }
  void Flush() override {}

 private:
  std::unique_ptr<Assimp::IOStream> from_;
  int reads_past_end_ = 0;
};

/// Whether a material file begins with a material: assimp ends the program if a property comes first.
bool begins_with_material(const fs::path& mtl) {
  std::ifstream file(mtl);
  std::string first;
  while (file >> first && first.starts_with("#")) std::getline(file, first);
  return !file || first == "newmtl";
}

std::string ending_of(const fs::path& path) { return lower(path.extension().string()); }

/// Text that assimp reads instead of a file's.
class TextStream : public Assimp::MemoryIOStream {
 public:
  static TextStream* of(const std::string& text) {
    auto* bytes = new uint8_t[text.size()];
    std::copy(text.begin(), text.end(), bytes);
    return new TextStream(bytes, text.size());
  }

 private:
  TextStream(uint8_t* bytes, size_t size) : MemoryIOStream(bytes, size, true) {}
};

}  // namespace

bool AssimpFiles::Exists(const char* file) const {
  return fs::exists(file) || fs::exists(percent_decoded(file));  // assimp's test would wait for a pipe
}

Assimp::IOStream* AssimpFiles::Open(const char* file, const char* mode) {
  const fs::path path = fs::exists(file) ? std::string(file) : percent_decoded(file);
  if (!fs::is_directory(path)) check_regular(path);
  if (!is_allowed(path)) return nullptr;
  const std::string ending = ending_of(path);
  if (ending == ".mtl") return open_mtl(path);
  Assimp::IOStream* stream = ending == ".obj" ? open_obj(path) : DefaultIOSystem::Open(path.c_str(), mode);
  return stream ? new EndingStream(stream) : nullptr;
}

bool AssimpFiles::is_allowed(const fs::path& path) {
  try {
    if (fs::exists(path)) opens_file(path);
    return true;
  } catch (const UsageError&) {
    refused = std::current_exception();
    return false;
  }
}

Assimp::IOStream* AssimpFiles::open_obj(const fs::path& path) {
  if (!fs::exists(path)) return nullptr;
  try {
    const ObjText obj = readable_obj(read_text(path), path.string());
    faces = obj.faces;
    return obj.text.empty() ? nullptr : TextStream::of(obj.text);
  } catch (const Error& error) {  // assimp would not report it
    why_not = error.what();
    return nullptr;
  }
}

Assimp::IOStream* AssimpFiles::open_mtl(const fs::path& path) {
  const bool is_usable = begins_with_material(path) && fs::exists(path);
  (is_usable ? found : missing).push_back(path.filename().string());
  if (!is_usable) return nullptr;
  const MtlText mtl = readable_mtl(read_text(path));
  left_out.insert(left_out.end(), mtl.left_out.begin(), mtl.left_out.end());
  return mtl.text.empty() ? nullptr : new EndingStream(TextStream::of(mtl.text));
}

void check_scene_file(const fs::path& path) {
  std::error_code failed;
  const fs::file_status status = fs::status(path, failed);
  if (!fs::exists(status)) throw Error("{}: no such file", path.string());
  if (fs::is_directory(status)) throw Error("{}: is a folder; a scene is a file (OBJ, glTF, GLB)", path.string());
  check_regular(path);
  if (!std::ifstream(path)) throw Error("{}: cannot be opened for reading", path.string());
  if (fs::is_regular_file(status) && fs::file_size(path) == 0) throw Error("{}: is empty (0 bytes)", path.string());
}

}  // namespace gloam
