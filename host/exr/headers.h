// The headers of an open EXR file: its parts, the views that the parts belong to, and attributes of any part.
#pragma once

#include <OpenEXR/ImfMultiPartInputFile.h>

#include <optional>
#include <string>
#include <vector>

#include "exr/channel_names.h"

namespace gloam {

/// Where attributes of a view may stand: a header, and what precedes the attributes' names there ("right.", or nothing).
struct AttributePlace {
  const Imf::Header* header;
  std::string prefix;
};

class Headers {
 public:
  Headers() = default;
  /// The file must outlive the headers.
  explicit Headers(const Imf::MultiPartInputFile& file);

  int parts() const { return file_->parts(); }
  const Imf::Header& of_part(int part) const { return file_->header(part); }
  /// The header that speaks for a view: that of the view's first part, else the file's first.
  const Imf::Header& of_view(const std::string& view) const;
  /// In the order in which attributes of a view are looked up.
  std::vector<AttributePlace> places_of(const std::string& view) const;

  /// The attribute `multiView` of the first part that has it; else empty.
  const std::vector<std::string>& listed_views() const { return listed_views_; }
  /// No attribute names a view, and the names of the parts do.
  bool has_views_by_part_names() const { return has_views_by_part_names_; }
  /// In the order of the file.
  std::vector<FileChannel> channels() const;

  /// The first part's value that has the attribute.
  std::optional<double> number(const std::string& name) const;
  /// The first text of this name that is not empty.
  std::string text(const std::string& name) const;
  bool has(const std::string& name) const;

 private:
  void find_views();
  const std::string& view_of_part(int part) const { return part_views_[size_t(part)]; }

  const Imf::MultiPartInputFile* file_ = nullptr;
  std::vector<std::string> listed_views_;
  std::vector<std::string> part_views_;  ///< by the attribute `view`, else by the parts' names; "" where nothing tells
  bool has_views_by_part_names_ = false;
};

}  // namespace gloam
