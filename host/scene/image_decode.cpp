#include "scene/image_decode.h"

#include <climits>
#include <fstream>
#include <memory>

#include "base/file_ledger.h"
#include "base/files.h"
#include "gloam/error.h"

#define STB_IMAGE_IMPLEMENTATION
#define STB_IMAGE_STATIC
#define STBI_NO_STDIO
#ifdef __SANITIZE_ADDRESS__
#define STBI_NO_SIMD  // GCC refuses its intrinsics where shifts are watched
#endif
#include <stb/stb_image.h>

namespace gloam {
namespace {

/// 16384 x 16384: a gigabyte of texels. A header may overstate its size.
constexpr size_t most_texels = size_t(1) << 28;

std::string failure() {
  const char* reason = stbi_failure_reason();
  return reason && *reason ? reason : "damaged";
}

}  // namespace

Texture decode_image(const std::string& name, const uint8_t* bytes, size_t size) {
  if (size == 0) throw Error("the file is empty");
  if (size > size_t(INT_MAX)) throw Error("the file has over 2 GB");
  Texture texture;
  texture.name = name;
  int channels = 0;
  if (!stbi_info_from_memory(bytes, int(size), &texture.width, &texture.height, &channels)) throw Error(failure());
  if (texture.width <= 0 || texture.height <= 0 || size_t(texture.width) > most_texels / size_t(texture.height))
    throw Error("{}x{} texels; up to 16384x16384 are read", texture.width, texture.height);
  const std::unique_ptr<stbi_uc, void (*)(void*)> texels(
      stbi_load_from_memory(bytes, int(size), &texture.width, &texture.height, &channels, 4), stbi_image_free);
  if (!texels) throw Error(failure());
  texture.texels.assign(texels.get(), texels.get() + size_t(4) * size_t(texture.width) * size_t(texture.height));
  return texture;
}

Texture read_image(const std::filesystem::path& path) {
  check_regular(path);
  std::error_code failed;
  const auto size = std::filesystem::file_size(path, failed);
  std::ifstream file(path, std::ios::binary);
  if (failed || !file) throw Error("the file cannot be opened");
  opens_file(path);
  if (size > size_t(INT_MAX)) throw Error("the file has over 2 GB");
  std::vector<uint8_t> bytes(size);
  if (!file.read(reinterpret_cast<char*>(bytes.data()), std::streamsize(size))) throw Error("the file cannot be read");
  return decode_image(path.filename().string(), bytes.data(), bytes.size());
}

}  // namespace gloam
