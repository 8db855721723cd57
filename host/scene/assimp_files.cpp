#include "scene/assimp_files.h"

#include <assimp/MemoryIOWrapper.h>

#include <algorithm>
#include <assimp/IOStream.hpp>
#include <cctype>
#include <fstream>
#include <memory>
#include <stdexcept>

#include "base/file_ledger.h"
#include "base/files.h"
#include "base/words.h"
#include "gloam/error.h"
#include "scene/import_materials.h"
#include "scene/obj_text.h"

namespace gloam {
namespace {

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
