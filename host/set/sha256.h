// SHA-256, as sixty-four hexadecimal digits.
#pragma once

#include <memory>
#include <string>
#include <string_view>

namespace gloam::sets {

/// A sum over bytes that come in pieces.
class Sha256 {
 public:
  Sha256();
  ~Sha256();
  Sha256(const Sha256&) = delete;
  Sha256& operator=(const Sha256&) = delete;

  void add(std::string_view bytes);
  /// Ends the sum.
  std::string digits();

 private:
  struct State;
  std::unique_ptr<State> state_;
};

std::string sha256_of(std::string_view bytes);

/// Whether a text is sixty-four hexadecimal digits in lower case.
bool is_sha256(std::string_view text);

}  // namespace gloam::sets
