// Identifies the inputs of a kept file: a 64-bit FNV-1a hash over the bytes of plain values.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <type_traits>
#include <vector>

#include "base/hash.h"
#include "gloam/frame.h"
#include "gloam/scene/scene.h"

namespace gloam {

class Fingerprint {
 public:
  void add_bytes(const void* data, size_t count) { state_ = hash_of({static_cast<const char*>(data), count}, state_); }
  template <typename Value>
  void add(const Value& value) {
    static_assert(std::is_trivially_copyable_v<Value> && !std::is_pointer_v<Value>);
    add_bytes(&value, sizeof value);
  }
  /// A list and its length, so that neighbouring lists cannot be confused.
  template <typename Value>
  void add(const std::vector<Value>& values) {
    add(values.size());
    add_bytes(values.data(), values.size() * sizeof(Value));
  }
  void add(const std::string& text) {
    add(text.size());
    add_bytes(text.data(), text.size());
  }
  /// All that rays can meet: triangles, normals, cut-outs and positions.
  void add(const Scene& scene);
  /// The light that rays see: materials, textures and lights.
  void add_light(const Scene& scene);
  /// How surfaces reflect: roughness and reflectance of every view.
  void add_gloss(const Frame& frame);
  /// The starts of rays: depth and normals of every view, and its camera.
  void add(const Frame& frame);

  /// 16 hexadecimal digits.
  std::string text() const;

 private:
  uint64_t state_ = hash_of({});
};

}  // namespace gloam
