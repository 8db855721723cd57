#include "exr/options_beside.h"

namespace gloam {

ReadOptions options_beside(const ReadOptions& options, const std::string& path) {
  ReadOptions own = options;
  own.channels.clear();
  own.plane_files.clear();
  if (own.views.empty()) return own;
  ReadOptions any = own;
  any.views.clear();
  if (FrameFile(path, any).views().size() == 1) own.views.clear();
  return own;
}

}  // namespace gloam
