// The headers of an open EXR file: its parts, the views that the parts belong to, and attributes of any part.
#pragma once

#include <OpenEXR/ImfMultiPartInputFile.h>

#include <optional>
#include <string>
#include <vector>

#include "exr/channel_names.h"

namespace gloam {

/// A place for attributes of a view: a header, and the prefix of the attributes' names there ("right.", or nothing).
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
  /// The header with the attributes of a view: that of the view's first part, else the file's first. Added parts (added_parts.h)
  /// have none.
  const Imf::Header& of_view(const std::string& view) const;
  /// The places where attributes of a view are looked up, in order.
  std::vector<AttributePlace> places_of(const std::string& view) const;

  /// The attribute `multiView` of the first part that has it; else empty.
  const std::vector<std::string>& listed_views() const { return listed_views_; }
  /// Whether the views are named by the parts' names only, not by attributes.
  bool has_views_by_part_names() const { return has_views_by_part_names_; }
  /// All channels, in file order.
  std::vector<FileChannel> channels() const;

  /// The attribute of the first part that has it.
  std::optional<double> number(const std::string& name) const;
  /// The first text attribute of this name that is not empty.
  std::string text(const std::string& name) const;
  /// As `text`, for what is said of a part's channels: an added part (added_parts.h) speaks for itself, and for no other.
  std::string text_for_part(int part, const std::string& name) const;
  bool has(const std::string& name) const;

 private:
  void find_views();
  const std::string& view_of_part(int part) const { return part_views_[size_t(part)]; }

  const Imf::MultiPartInputFile* file_ = nullptr;
  std::vector<std::string> listed_views_;
  std::vector<std::string> part_views_;  ///< by the attribute `view`, else by the parts' names; "" if unknown
  bool has_views_by_part_names_ = false;
};

}  // namespace gloam
