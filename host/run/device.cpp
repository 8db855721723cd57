#include <dlfcn.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cctype>
#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <new>

#include "gloam/error.h"
#include "run/device_impl.h"
#include "run/driver.h"
#include "run/kernel_sources.h"

namespace gloam {
namespace {

std::string lower(std::string text) {
  std::transform(text.begin(), text.end(), text.begin(), [](unsigned char c) { return std::tolower(c); });
  return text;
}

std::string trimmed(std::string text) {
  while (!text.empty() && (text.back() == '\0' || std::isspace((unsigned char)text.back()))) text.pop_back();
  return text;
}

/// Vector width that pays off: PoCL compiles vectors to vector registers; every other CPU implementation vectorises across
/// work-items by itself, and GPUs do so in hardware.
int suitable_lanes(const cl::Device& device, const std::string& platform) {
  if (!(device.getInfo<CL_DEVICE_TYPE>() & CL_DEVICE_TYPE_CPU) || platform != "Portable Computing Language") return 1;
  const unsigned width = device.getInfo<CL_DEVICE_PREFERRED_VECTOR_WIDTH_FLOAT>();
  return width >= 16 ? 16 : width >= 8 ? 8 : width >= 4 ? 4 : 1;
}

DeviceInfo describe(const cl::Platform& platform, const cl::Device& device) {
  DeviceInfo info;
  info.platform = trimmed(platform.getInfo<CL_PLATFORM_NAME>());
  info.name = trimmed(device.getInfo<CL_DEVICE_NAME>());
  info.driver = trimmed(device.getInfo<CL_DRIVER_VERSION>());
  const cl_device_type type = device.getInfo<CL_DEVICE_TYPE>();
  info.type = type & CL_DEVICE_TYPE_GPU ? "gpu" : type & CL_DEVICE_TYPE_CPU ? "cpu" : "other";
  info.lanes = suitable_lanes(device, info.platform);
  const std::string extensions = device.getInfo<CL_DEVICE_EXTENSIONS>();
  info.has_double = extensions.find("cl_khr_fp64") != std::string::npos;
  info.shares_memory = info.type == "cpu";
  // Rusticl states a timer resolution of 0, and its timestamps mean nothing.
  info.has_timestamps = device.getInfo<CL_DEVICE_PROFILING_TIMER_RESOLUTION>() > 0;
  info.rounds_correctly = device.getInfo<CL_DEVICE_SINGLE_FP_CONFIG>() & CL_FP_CORRECTLY_ROUNDED_DIVIDE_SQRT;
  info.memory = device.getInfo<CL_DEVICE_GLOBAL_MEM_SIZE>();
  info.largest_buffer = device.getInfo<CL_DEVICE_MAX_MEM_ALLOC_SIZE>();
  return info;
}

struct Found {
  cl::Device device;
  DeviceInfo info;
};

/// Whether PoCL can keep its kernels below this folder, which is made if it is missing.
bool usable(const std::filesystem::path& folder) {
  std::error_code unknown;
  std::filesystem::create_directories(folder, unknown);
  std::string probe = (folder / ".gloam-XXXXXX").string();  // root may write anywhere, by the permissions
  return mkdtemp(probe.data()) && rmdir(probe.c_str()) == 0;
}

/// A folder into which nobody else can have put kernels.
std::filesystem::path own_temporary_folder() {
  std::error_code unset;  // TMPDIR may name a missing folder
  std::filesystem::path base = std::filesystem::temp_directory_path(unset);
  if (unset || !usable(base)) base = "/tmp";
  const std::filesystem::path folder = base / fmt::format("gloam-kernels-{}", getuid());
  mkdir(folder.c_str(), 0700);
  struct stat facts;
  const bool ours = lstat(folder.c_str(), &facts) == 0 && S_ISDIR(facts.st_mode) && facts.st_uid == getuid() &&
                    (facts.st_mode & 077) == 0;
  if (ours) return folder;
  std::string pattern = (base / "gloam-kernels-XXXXXX").string();
  if (!mkdtemp(pattern.data()))
    throw Error(
        "no folder to keep compiled kernels in: {}: {}; set POCL_CACHE_DIR or HOME to a folder that can be written",
        base.string(), std::strerror(errno));
  return pattern;
}

/// The reason why an installed driver gives no platform; empty if none is installed. The loader does not report it.
std::string why_no_platform() {
  const char* given = std::getenv("OCL_ICD_VENDORS");
  const std::filesystem::path vendors = given && *given ? given : "/etc/OpenCL/vendors";
  std::error_code failed;
  std::filesystem::directory_iterator files(vendors, failed);
  if (failed == std::errc::no_such_file_or_directory || failed == std::errc::not_a_directory) return "";
  if (failed) return fmt::format("{}: {}", vendors.string(), failed.message());
  for (const auto& file : files) {
    std::string library;
    if (file.path().extension() != ".icd") continue;
    if (!std::getline(std::ifstream(file.path()), library))
      return fmt::format("{}: {}", file.path().string(), std::strerror(errno));
    void* const handle = dlopen(trimmed(library).c_str(), RTLD_LAZY | RTLD_LOCAL);
    if (!handle) return fmt::format("{}: {}", file.path().string(), dlerror());
    dlclose(handle);
  }
  return "";
}

/// Platforms are enumerated one by one: one without devices (a driver without its hardware) is skipped.
std::vector<Found> find_devices() {
  const DriverAtWork driver;
  std::vector<cl::Platform> platforms;
  try {
    cl::Platform::get(&platforms);
  } catch (const cl::Error&) {
    platforms.clear();
  }
  if (platforms.empty()) {
    if (const std::string why = why_no_platform(); !why.empty())
      throw Error("no OpenCL platform could be loaded: {}", why);
    throw Error("no OpenCL platform found; on Debian or Ubuntu, 'apt install pocl-opencl-icd' runs gloam on the CPU");
  }
  std::vector<Found> found;
  for (const cl::Platform& platform : platforms) {
    std::vector<cl::Device> devices;
    try {
      platform.getDevices(CL_DEVICE_TYPE_ALL, &devices);
    } catch (const cl::Error&) {
      continue;
    }
    for (const cl::Device& device : devices) {
      try {
        found.push_back({device, describe(platform, device)});
      } catch (const cl::Error&) {
        continue;  // one broken driver does not hide the others
      }
    }
  }
  if (found.empty()) {
    throw Error(
        "no OpenCL device found on {} platform(s); on Debian or Ubuntu, 'apt install pocl-opencl-icd' runs gloam on "
        "the CPU",
        platforms.size());
  }
  return found;
}

std::string label(const DeviceInfo& info) { return fmt::format("'{}: {}'", info.platform, info.name); }

/// The first GPU, else the first CPU whose vectors gloam can use, else the first device.
const Found& choose_device(const std::vector<Found>& found, const std::string& text) {
  if (!text.empty()) {
    std::vector<std::string> labels;
    for (const Found& f : found) {
      if (lower(label(f.info)).find(lower(text)) != std::string::npos) return f;
      labels.push_back(label(f.info));
    }
    throw Error("no device matches '{}'; there are {} (gloam list devices)", text, enumerate(labels));
  }
  for (const Found& f : found) {
    if (f.info.type == "gpu") return f;
  }
  const auto widest = std::max_element(found.begin(), found.end(),
                                       [](const Found& a, const Found& b) { return a.info.lanes < b.info.lanes; });
  return *widest;
}

/// The compiler's log on one line, shortened.
std::string short_log(std::string log) {
  log = trimmed(log);
  for (size_t at = 0; (at = log.find('\n', at)) != std::string::npos;) log.replace(at, 1, "; ");
  return log.size() > 4000 ? log.substr(0, 4000) + " ..." : log;
}

}  // namespace

void give_pocl_a_folder() {
  // PoCL uses the first of these that is set; it aborts if that one is empty.
  for (const auto& [name, below] :
       {std::pair("POCL_CACHE_DIR", ""), std::pair("XDG_CACHE_HOME", ""), std::pair("HOME", ".cache")}) {
    const char* folder = std::getenv(name);
    if (folder && *folder == '\0')
      unsetenv(name);
    else if (folder && usable(std::filesystem::path(folder) / below))
      return;
    else if (folder)
      break;
  }
  setenv("POCL_CACHE_DIR", own_temporary_folder().c_str(), 1);
}

std::vector<DeviceInfo> list_devices() {
  std::vector<DeviceInfo> infos;
  for (const Found& f : find_devices()) infos.push_back(f.info);
  return infos;
}

std::string cl_error_name(int code) {
  static const std::map<int, std::string> names = {
      {-1, "CL_DEVICE_NOT_FOUND"},
      {-2, "CL_DEVICE_NOT_AVAILABLE"},
      {-3, "CL_COMPILER_NOT_AVAILABLE"},
      {-4, "CL_MEM_OBJECT_ALLOCATION_FAILURE"},
      {-5, "CL_OUT_OF_RESOURCES"},
      {-6, "CL_OUT_OF_HOST_MEMORY"},
      {-11, "CL_BUILD_PROGRAM_FAILURE"},
      {-14, "CL_EXEC_STATUS_ERROR_FOR_EVENTS_IN_WAIT_LIST"},
      {-30, "CL_INVALID_VALUE"},
      {-33, "CL_INVALID_DEVICE"},
      {-34, "CL_INVALID_CONTEXT"},
      {-36, "CL_INVALID_COMMAND_QUEUE"},
      {-38, "CL_INVALID_MEM_OBJECT"},
      {-45, "CL_INVALID_PROGRAM_EXECUTABLE"},
      {-46, "CL_INVALID_KERNEL_NAME"},
      {-48, "CL_INVALID_KERNEL"},
      {-49, "CL_INVALID_ARG_INDEX"},
      {-50, "CL_INVALID_ARG_VALUE"},
      {-51, "CL_INVALID_ARG_SIZE"},
      {-52, "CL_INVALID_KERNEL_ARGS"},
      {-54, "CL_INVALID_WORK_GROUP_SIZE"},
      {-55, "CL_INVALID_WORK_ITEM_SIZE"},
      {-61, "CL_INVALID_BUFFER_SIZE"},
      {-63, "CL_INVALID_GLOBAL_WORK_SIZE"},
      {-1001, "CL_PLATFORM_NOT_FOUND_KHR"},
  };
  const auto found = names.find(code);
  return found == names.end() ? fmt::format("OpenCL error {}", code) : found->second;
}

Device::Device(const std::string& text) : impl_(std::make_unique<Impl>()) {
  const std::vector<Found> found = find_devices();
  const Found& chosen = choose_device(found, text);
  const DriverAtWork driver;
  try {
    impl_->info = chosen.info;
    impl_->device = chosen.device;
    impl_->context = cl::Context(chosen.device);
    impl_->queue = cl::CommandQueue(impl_->context, chosen.device, cl::QueueProperties::Profiling);
  } catch (const cl::Error& error) {
    throw Error("device {}: {} ({})", label(chosen.info), error.what(), cl_error_name(error.err()));
  }
}

Device::~Device() = default;
Device::Device(Device&&) noexcept = default;

Device::Impl& Device::impl() {
  if (!impl_) throw Error("this Device has been moved to another variable; use that one");
  return *impl_;
}

const DeviceInfo& Device::info() const { return const_cast<Device*>(this)->impl().info; }

cl::Program& Device::Impl::program(const std::string& source, const std::string& kernel, const std::string& options) {
  const std::string key = source + " " + kernel + " " + options;
  const auto known = programs.find(key);
  if (known != programs.end()) return known->second;
  const DriverAtWork driver;
  auto built = std::make_unique<cl::Program>(context, with_one_kernel(flatten(source), kernel));
  try {
    built->build({device}, options.c_str());
  } catch (const cl::Error& error) {
    throw Error("kernels/{} does not build on {} with {} ({}): {}", source, label(info), options,
                cl_error_name(error.err()), short_log(built->getBuildInfo<CL_PROGRAM_BUILD_LOG>(device)));
  } catch (const std::exception& error) {
    // PoCL's compiler has thrown through PoCL, whose locks stay taken: releasing the program would wait for ever.
    built.release();
    restart_without_kept_kernels();
    throw Error("kernels/{} cannot be compiled on {}: {}{}", source, label(info), error.what(), memory_limit());
  }
  return programs.emplace(key, std::move(*built)).first->second;
}

}  // namespace gloam
