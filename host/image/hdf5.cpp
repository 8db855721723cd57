#include "image/hdf5.h"

#include "gloam/error.h"
#include "image/stored_array.h"

#if GLOAM_HDF5
#define H5_USE_110_API  // later versions keep its functions under this name
#include <dlfcn.h>
#include <hdf5.h>

#include <cstdlib>

#include "base/file_ledger.h"
#include "base/files.h"

namespace gloam {
namespace {

/// What is called of libhdf5. It is loaded when a file of its is read: it brings 30 other libraries, and a third of the time that a command
/// takes to start.
struct Hdf5 {
#define GLOAM_HDF5_FUNCTIONS(X)                                                                                   \
  X(H5Fopen)                                                                                                      \
  X(H5Fclose)                                                                                                     \
  X(H5Eset_auto2)                                                                                                 \
  X(H5Ovisit)                                                                                                     \
  X(H5Dopen2)                                                                                                     \
  X(H5Dclose) X(H5Dget_type) X(H5Dget_space) X(H5Dread) X(H5Dget_storage_size) X(H5Tclose) X(H5Tget_class)        \
      X(H5Tget_size) X(H5Tget_sign) X(H5Tget_order) X(H5Tget_precision) X(H5Sclose) X(H5Sget_simple_extent_ndims) \
          X(H5Sget_simple_extent_dims)
#define GLOAM_HDF5_POINTER(name) decltype(&::name) name##_ = nullptr;
  GLOAM_HDF5_FUNCTIONS(GLOAM_HDF5_POINTER)
  std::string why_missing;

  Hdf5() {
    ::setenv("HDF5_USE_FILE_LOCKING", "FALSE", 0);  // folders that many machines share may know no locks
    void* library = ::dlopen(GLOAM_HDF5_LIBRARY, RTLD_NOW | RTLD_LOCAL);
    if (!library) {
      why_missing = ::dlerror();
      return;
    }
    const auto find = [&](auto& pointer, const char* name) {
      pointer = reinterpret_cast<std::remove_reference_t<decltype(pointer)>>(::dlsym(library, name));
      if (!pointer) why_missing = fmt::format("it has no {}", name);
    };
#define GLOAM_HDF5_TEXT(name) #name
#define GLOAM_HDF5_FIND(name) find(name##_, GLOAM_HDF5_TEXT(name));
    GLOAM_HDF5_FUNCTIONS(GLOAM_HDF5_FIND)
    if (why_missing.empty()) H5Eset_auto2_(H5E_DEFAULT, nullptr, nullptr);  // errors are told in a line of ours
  }
};

const Hdf5& hdf5() {
  static const Hdf5 loaded;
  return loaded;
}

/// Something of libhdf5's that is closed at the end.
class Handle {
 public:
  Handle(hid_t id, herr_t (*close)(hid_t)) : id_(id), close_(close) {}
  ~Handle() {
    if (id_ >= 0) close_(id_);
  }
  Handle(const Handle&) = delete;
  Handle& operator=(const Handle&) = delete;
  hid_t id() const { return id_; }
  explicit operator bool() const { return id_ >= 0; }

 private:
  hid_t id_;
  herr_t (*close_)(hid_t);
};

herr_t add_data_set(hid_t, const char* name, const H5O_info_t* info, void* names) {
  constexpr size_t most = 1000;
  auto& list = *static_cast<std::vector<std::string>*>(names);
  if (info->type == H5O_TYPE_DATASET && list.size() < most) list.emplace_back(name);
  return 0;
}

/// False for texts and the like.
bool take_type(hid_t stored, StoredArray& array) {
  const H5T_class_t kind = hdf5().H5Tget_class_(stored);
  if (kind != H5T_FLOAT && kind != H5T_INTEGER) return false;
  array.bytes = hdf5().H5Tget_size_(stored);
  array.is_big_endian = hdf5().H5Tget_order_(stored) == H5T_ORDER_BE;
  array.kind = kind == H5T_FLOAT ? 'f' : hdf5().H5Tget_sign_(stored) == H5T_SGN_NONE ? 'u' : 'i';
  return is_known_type(array.kind, array.bytes) && hdf5().H5Tget_precision_(stored) == 8 * array.bytes;
}

bool take_shape(hid_t data_set, StoredArray& array) {
  const Handle space(hdf5().H5Dget_space_(data_set), hdf5().H5Sclose_);
  const int rank = space ? hdf5().H5Sget_simple_extent_ndims_(space.id()) : 0;
  if (rank < 2 || rank > 5) return false;
  std::vector<hsize_t> sizes(static_cast<size_t>(rank));
  hdf5().H5Sget_simple_extent_dims_(space.id(), sizes.data(), nullptr);
  array.shape.assign(sizes.begin(), sizes.end());
  return is_image_shape(array.shape);
}

/// Adds the image of a data set, if it may be one.
void add_image(hid_t file, const std::string& data_set_name, const std::string& name, long long most_pixels,
               std::vector<ImageValues>& images) {
  const std::string full = fmt::format("{}, data set '{}'", name, printable(data_set_name));
  const Handle data_set(hdf5().H5Dopen2_(file, data_set_name.c_str(), H5P_DEFAULT), hdf5().H5Dclose_);
  if (!data_set) throw Error("{}: is damaged", full);
  StoredArray array;
  const Handle type(hdf5().H5Dget_type_(data_set.id()), hdf5().H5Tclose_);
  if (!take_type(type.id(), array) || !take_shape(data_set.id(), array)) return;
  size_t count = 0;
  if (!count_of(array.shape, 4 * (unsigned long long)most_pixels, count))
    throw Error("{}: has the shape ({}); images of {} pixels are read at most", full, fmt::join(array.shape, ", "),
                most_pixels);
  // What is not stored reads as a constant, and no filter makes so much of so little.
  constexpr unsigned long long most_packed = 4096;
  if (count * array.bytes / most_packed > hdf5().H5Dget_storage_size_(data_set.id()))
    throw Error("{}: claims {} bytes and stores {}", full, count * array.bytes,
                hdf5().H5Dget_storage_size_(data_set.id()));
  array.values.resize(count * array.bytes);
  if (hdf5().H5Dread_(data_set.id(), type.id(), H5S_ALL, H5S_ALL, H5P_DEFAULT, array.values.data()) < 0)
    throw Error("{}: cannot be decoded; it is damaged, or compressed by a filter that libhdf5 lacks", full);
  images.push_back(image_of(array, full, most_pixels));
  images.back().name = data_set_name;
}

}  // namespace

std::vector<ImageValues> images_of_hdf5(const std::filesystem::path& path, long long most_pixels) {
  check_regular(path);
  opens_file(path);
  if (!hdf5().why_missing.empty())
    throw Error("{}: is HDF5, and {} cannot be loaded ({}); install libhdf5, or save the file as NPZ", path.string(),
                GLOAM_HDF5_LIBRARY, hdf5().why_missing);
  constexpr unsigned read_only = 0;  // H5F_ACC_RDONLY, a macro that calls the library
  const Handle file(hdf5().H5Fopen_(path.c_str(), read_only, H5P_DEFAULT), hdf5().H5Fclose_);
  if (!file) throw Error("{}: cannot be read as HDF5: it is none, or is damaged", path.string());
  std::vector<std::string> names;
  hdf5().H5Ovisit_(file.id(), H5_INDEX_NAME, H5_ITER_INC, add_data_set, &names);
  std::vector<ImageValues> images;
  for (const std::string& name : names) {
    check_all_sizes(images, path.string(), most_pixels);
    add_image(file.id(), name, path.string(), most_pixels, images);
  }
  return images;
}

}  // namespace gloam

#else

namespace gloam {

std::vector<ImageValues> images_of_hdf5(const std::filesystem::path& path, long long) {
  throw Error("{}: is HDF5, which this build leaves out; install libhdf5-dev and build again, or save it as NPZ",
              path.string());
}

}  // namespace gloam

#endif
