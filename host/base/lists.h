// Lists of names: short, so linear search is fine.
#pragma once

#include <algorithm>
#include <string>
#include <vector>

namespace gloam {

inline bool contains(const std::vector<std::string>& list, const std::string& item) {
  return std::find(list.begin(), list.end(), item) != list.end();
}

inline void add_new(std::vector<std::string>& list, const std::string& item) {
  if (!contains(list, item)) list.push_back(item);
}

inline void add_new(std::vector<std::string>& list, const std::vector<std::string>& items) {
  for (const std::string& item : items) add_new(list, item);
}

}  // namespace gloam
