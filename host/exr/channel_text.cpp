#include "exr/channel_text.h"

#include <cctype>

namespace gloam::channel_names {

std::vector<std::string> split(const std::string& text, char separator) {
  std::vector<std::string> pieces;
  size_t begin = 0;
  for (size_t end; (end = text.find(separator, begin)) != std::string::npos; begin = end + 1)
    pieces.push_back(text.substr(begin, end - begin));
  pieces.push_back(text.substr(begin));
  return pieces;
}

std::string join(const std::vector<std::string>& pieces) {
  std::string text;
  for (const std::string& piece : pieces) text += (text.empty() ? "" : ".") + piece;
  return text;
}

std::string canonical(std::string_view layer) {
  std::string text;
  for (char c : layer)
    if (std::isalnum(static_cast<unsigned char>(c))) text += char(std::tolower(static_cast<unsigned char>(c)));
  for (std::string_view prefix : {"finalimage", "pathtracer", "movierenderqueue"})
    if (text.starts_with(prefix) && text.size() > prefix.size()) text.erase(0, prefix.size());
  return text;
}

std::string without_view(const std::string& name, const std::string& view) {
  if (view.empty()) return name;
  for (char separator : {'_', '.', '-'}) {
    if (name.ends_with(separator + view)) return name.substr(0, name.size() - view.size() - 1);
    if (name.starts_with(view + separator)) return name.substr(view.size() + 1);
  }
  return name;
}

}  // namespace gloam::channel_names
