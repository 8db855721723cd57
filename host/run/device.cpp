#include "gloam/device.h"

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
#include <nlohmann/json.hpp>

#include "base/words.h"
#include "gloam/error.h"
#include "run/build_log.h"
#include "run/device_impl.h"
#include "run/device_record.h"
#include "run/driver.h"
#include "run/kept_folders.h"
#include "run/tuning.h"
#include "technique/data_files.h"
#include "technique/kernel_sources.h"

namespace gloam {
namespace {

/// What the table says of a kind of device.
struct KnownDevice {
  Tuning tuning;
  bool keeps_kernels = false;  ///< the driver keeps compiled kernels on disk by itself
};

/// The first row of the table that fits a device. `vector_width`: floats per vector that the driver prefers.
KnownDevice known_device(const DeviceInfo& info, int vector_width) {
  static const nlohmann::ordered_json table = nlohmann::ordered_json::parse(data_files().at("devices.json"));
  for (const nlohmann::ordered_json& row : table) {
    const bool fits = row.value("platform", info.platform) == info.platform &&
                      row.value("type", info.type) == info.type && row.value("vector", 0) <= vector_width &&
                      info.name.find(row.value("name", "")) != std::string::npos;
    if (fits) return {tuning_in(row).value(), row.value("keeps_kernels", false)};
  }
  return {};
}

std::string trimmed(std::string text) {
  while (!text.empty() && (text.back() == '\0' || std::isspace((unsigned char)text.back()))) text.pop_back();
  return text;
}

DeviceInfo describe(const cl::Platform& platform, const cl::Device& device) {
  DeviceInfo info;
  info.platform = trimmed(platform.getInfo<CL_PLATFORM_NAME>());
  info.name = trimmed(device.getInfo<CL_DEVICE_NAME>());
  info.driver = trimmed(device.getInfo<CL_DRIVER_VERSION>());
  const cl_device_type type = device.getInfo<CL_DEVICE_TYPE>();
  info.type = type & CL_DEVICE_TYPE_GPU ? "gpu" : type & CL_DEVICE_TYPE_CPU ? "cpu" : "other";
  const KnownDevice known = known_device(info, int(device.getInfo<CL_DEVICE_PREFERRED_VECTOR_WIDTH_FLOAT>()));
  info.usual = info.tuning = known.tuning;
  info.keeps_kernels = known.keeps_kernels;
  if (const std::optional<DeviceRecord> record = find_record(info); record && record->tuning)
    info.tuning = *record->tuning;
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
    const PoclLeftovers leftovers;
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

/// Those whose label contains a text. Throws Error, with a list of all, if there is none.
std::vector<const Found*> matching(const std::vector<Found>& found, const std::string& text) {
  std::vector<const Found*> matches;
  std::vector<std::string> labels;
  for (const Found& f : found) {
    labels.push_back("'" + label_of(f.info) + "'");
    if (lower(labels.back()).find(lower(text)) != std::string::npos) matches.push_back(&f);
  }
  if (matches.empty())
    throw Error("no device matches '{}'; there are {} (gloam list devices)", text, enumerate(labels));
  return matches;
}

/// That of the label, else the first with the text; without one the first GPU, else the first CPU whose vectors gloam can use, else the first device.
const Found& choose_device(const std::vector<Found>& found, const std::string& text) {
  for (const Found& f : found) {
    if (!text.empty() && label_of(f.info) == text) return f;
  }
  if (!text.empty()) return *matching(found, text).front();
  for (const Found& f : found) {
    if (f.info.type == "gpu") return f;
  }
  const auto widest = std::max_element(found.begin(), found.end(), [](const Found& a, const Found& b) {
    return a.info.usual.lanes < b.info.usual.lanes;
  });
  return *widest;
}

}  // namespace

std::vector<DeviceInfo> list_devices(const std::string& text) {
  const std::vector<Found> found = find_devices();
  std::vector<DeviceInfo> infos;
  for (const Found* f : matching(found, text)) infos.push_back(f->info);
  return infos;
}

std::string label_of(const DeviceInfo& info) { return info.platform + ": " + info.name; }

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

Device::Device(const std::string& text, bool uses_measured_tuning) : impl_(std::make_unique<Impl>()) {
  const std::vector<Found> found = find_devices();
  const Found& chosen = choose_device(found, text);
  const DriverAtWork driver;
  try {
    impl_->info = chosen.info;
    if (!uses_measured_tuning) impl_->info.tuning = impl_->info.usual;
    impl_->device = chosen.device;
    impl_->context = cl::Context(chosen.device);
    impl_->queue = cl::CommandQueue(impl_->context, chosen.device, cl::QueueProperties::Profiling);
    if (!chosen.info.keeps_kernels) impl_->cache = own_kernel_cache();
  } catch (const cl::Error& error) {
    throw Error("device {}: {} ({})", "'" + label_of(chosen.info) + "'", error.what(), cl_error_name(error.err()));
  }
}

Device::Device(std::unique_ptr<Impl> impl) : impl_(std::move(impl)) {}

std::unique_ptr<Device::Impl> impl_of(const cl::CommandQueue& queue) {
  auto impl = std::make_unique<Device::Impl>();
  impl->queue = queue;
  impl->device = queue.getInfo<CL_QUEUE_DEVICE>();
  impl->context = queue.getInfo<CL_QUEUE_CONTEXT>();
  impl->info = describe(cl::Platform(impl->device.getInfo<CL_DEVICE_PLATFORM>()), impl->device);
  const cl_command_queue_properties properties = queue.getInfo<CL_QUEUE_PROPERTIES>();
  if (properties & CL_QUEUE_OUT_OF_ORDER_EXEC_MODE_ENABLE)
    throw Error("the queue of '{}' runs commands out of order; give one that keeps their order", label_of(impl->info));
  if (!(properties & CL_QUEUE_PROFILING_ENABLE)) impl->info.has_timestamps = false;
  if (!impl->info.keeps_kernels) impl->cache = own_kernel_cache();
  return impl;
}

Device::~Device() = default;
Device::Device(Device&&) noexcept = default;

Device::Impl& Device::impl() {
  if (!impl_) throw Error("this Device has been moved to another variable; use that one");
  return *impl_;
}

const DeviceInfo& Device::info() const { return const_cast<Device*>(this)->impl().info; }

/// What a compiled program depends on.
std::string Device::Impl::key_of(const std::string& source, const std::string& options) const {
  return fmt::format("{}\n{}\n{}\n{}\n{}", info.platform, info.name, info.driver, options, source);
}

/// The kept program; none if there is none that the driver takes.
std::unique_ptr<cl::Program> Device::Impl::kept_program(const std::string& key, const std::string& options) {
  const std::optional<std::string> binary = cache.find(key);
  if (!binary) return nullptr;
  try {
    const std::vector<unsigned char> bytes(binary->begin(), binary->end());
    auto program =
        std::make_unique<cl::Program>(context, std::vector<cl::Device>{device}, cl::Program::Binaries{bytes});
    program->build({device}, options.c_str());
    return program;
  } catch (const cl::Error&) {
    cache.remove(key);
    return nullptr;
  }
}

void Device::Impl::keep(const std::string& key, const cl::Program& program) const {
  try {
    // A caller's context may have several devices.
    const std::vector<cl::Device> devices = program.getInfo<CL_PROGRAM_DEVICES>();
    const std::vector<std::vector<unsigned char>> binaries = program.getInfo<CL_PROGRAM_BINARIES>();
    for (size_t i = 0; i < std::min(devices.size(), binaries.size()); ++i) {
      if (devices[i]() == device()) cache.keep(key, std::string(binaries[i].begin(), binaries[i].end()));
    }
  } catch (const cl::Error&) {  // a driver that gives none: the next process compiles again
  }
}

cl::Program& Device::Impl::program(const std::string& source, const std::string& kernel, const std::string& declaration,
                                   const std::string& options) {
  const std::string name = source + " " + kernel + " " + declaration + options;
  const auto known = programs.find(name);
  if (known != programs.end()) return known->second;
  const DriverAtWork driver;
  const std::string text = kernel_text(source, kernel, declaration), key = key_of(text, options);
  std::unique_ptr<cl::Program> built = kept_program(key, options);
  if (built) return programs.emplace(name, std::move(*built)).first->second;
  built = std::make_unique<cl::Program>(context, text);
  try {
    built->build({device}, options.c_str());
  } catch (const cl::Error& error) {
    const std::string log = trimmed(built->getBuildInfo<CL_PROGRAM_BUILD_LOG>(device));
    throw Error("{}", build_failure(label_of(info), kernel, options, log.empty() ? cl_error_name(error.err()) : log));
  } catch (const std::exception& error) {
    // PoCL's compiler has thrown through PoCL, whose locks stay taken: releasing the program would wait for ever.
    built.release();
    restart_without_kept_kernels();
    throw Error("kernels/{} cannot be compiled on {}: {}{}", source, "'" + label_of(info) + "'", error.what(),
                memory_limit());
  }
  if (!info.keeps_kernels) keep(key, *built);
  return programs.emplace(name, std::move(*built)).first->second;
}

}  // namespace gloam
