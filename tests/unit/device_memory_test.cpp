// Plans on planes in a device's memory, with a caller's queue.
#include "gloam/device_memory.h"

#include <gtest/gtest.h>

#include <CL/opencl.hpp>
#include <bit>
#include <cmath>
#include <limits>
#include <random>

#include "gloam/plan.h"
#include "gloam/planes.h"
#include "support/stress.h"
#include "support/techniques.h"

namespace gloam::test::device_memory_test {
namespace {

using Names = std::vector<std::string>;

/// A queue of the first device of OpenCL's default platform, as a program that draws would have it.
struct Caller {
  cl::Device device = cl::Device::getDefault();
  cl::Context context{device};
  cl::CommandQueue queue;
  explicit Caller(cl_command_queue_properties properties = 0) : queue(context, device, properties) {}

  cl::Buffer buffer(size_t bytes) const {
    const std::vector<float> nothing(bytes / 4, std::numeric_limits<float>::quiet_NaN());
    return {context, CL_MEM_READ_WRITE | CL_MEM_COPY_HOST_PTR, bytes, const_cast<float*>(nothing.data())};
  }
};

/// How a caller lays out planes, bytes.
struct Form {
  size_t offset, pitch, step, behind;  ///< `behind`: from the last row's begin to the buffer's end
};

/// A caller's buffers. Whatever is outside of the image is NaN.
class Memory {
 public:
  explicit Memory(const Caller& caller, int width, int height) : caller_(caller), width_(width), height_(height) {}

  DevicePlane plane(const std::string& name, const Form& form) {
    DevicePlane plane{name, {}, form.pitch};
    for (size_t i = 0; i < plane_kind(name).components.size(); ++i) {
      cl::Buffer& buffer =
          buffers_.emplace_back(caller_.buffer(form.offset + size_t(height_ - 1) * form.pitch + form.behind));
      plane.channels.push_back({buffer(), form.offset, form.step});
    }
    return plane;
  }

  void write(const DevicePlane& plane, const Plane& values) {
    for (size_t i = 0; i < plane.channels.size(); ++i)
      each_pixel(plane, i, [&](float& pixel, int x, int y) { pixel = values.channels[i].at(x, y); });
  }

  Plane read(const DevicePlane& plane) {
    Plane values{plane.name, {}};
    for (size_t i = 0; i < plane.channels.size(); ++i) {
      Channel& channel = values.channels.emplace_back(Layout(width_, height_), plane_kind(plane.name).outside);
      each_pixel(plane, i, [&](float& pixel, int x, int y) { channel.at(x, y) = pixel; });
    }
    return values;
  }

 private:
  template <typename Function>
  void each_pixel(const DevicePlane& plane, size_t channel, const Function& function) {
    const DeviceChannel& given = plane.channels[channel];
    cl::Buffer buffer(given.memory, true);
    std::vector<float> all(buffer.getInfo<CL_MEM_SIZE>() / 4);
    caller_.queue.enqueueReadBuffer(buffer, CL_TRUE, 0, all.size() * 4, all.data());
    for (int y = 0; y < height_; ++y) {
      for (int x = 0; x < width_; ++x)
        function(all[(given.offset + size_t(y) * plane.pitch + size_t(x) * given.step) / 4], x, y);
    }
    caller_.queue.enqueueWriteBuffer(buffer, CL_TRUE, 0, all.size() * 4, all.data());
  }

  const Caller& caller_;
  int width_, height_;
  std::vector<cl::Buffer> buffers_;
};

/// A frame's planes in a caller's memory, and what was computed of them.
struct Computed {
  Frame frame;
  Enqueued enqueued;
};

Computed compute_on_device(const Plan& plan, const Frame& frame, const Caller& caller, const Form& inputs,
                           const Form& results, bool is_clean, Device& device) {
  Memory memory(caller, frame.width(), frame.height());
  DeviceFrame given{frame.width(), frame.height(), {}};
  for (const View& view : frame.views) {
    DeviceView& to = given.views.emplace_back(DeviceView{view.name, view.camera, view.camera_before, {}, {}});
    for (const std::string& name : plan.inputs) {
      to.planes.push_back(memory.plane(name, inputs));
      memory.write(to.planes.back(), *view.find(name));
      to.planes.back().is_clean = is_clean;
    }
    for (const std::string& name : plan.outputs) to.results.push_back(memory.plane(name, results));
  }
  Computed computed{without_planes(frame), enqueue(plan, given, device)};
  const cl_event done = computed.enqueued.done.get();
  EXPECT_EQ(clWaitForEvents(1, &done), CL_SUCCESS);
  for (size_t i = 0; i < frame.views.size(); ++i) {
    for (const DevicePlane& result : given.views[i].results)
      computed.frame.views[i].planes[result.name] = memory.read(result);
  }
  return computed;
}

Computed compute_on_device(const Plan& plan, const Frame& frame, const Caller& caller, const Form& inputs,
                           const Form& results, bool is_clean = true) {
  Device device = device_of(caller.queue());
  return compute_on_device(plan, frame, caller, inputs, results, is_clean, device);
}

constexpr int width = 50, height = 33;

Form suitable() {
  const DeviceLayout layout = device_layout(width, height);
  return {layout.offset, layout.pitch, 4, layout.pitch + layout.offset};
}

/// AO from depth and normals, two eyes that look at one another, colours, layers, a list of pixels, several resolutions.
TEST(DeviceMemory, GivesTheSameBitsAsARunAndCopiesNothing) {
  const Caller caller;
  for (const char* name :
       {"gtao", "evidence", "stereo-ao", "indirect", "multires", "sssr", "sd-hbao+", "normals", "specular-occlusion"}) {
    const Technique& technique = find_technique(name);
    Frame frame = shoot(perspective(width, height), room());
    const Plan plan = plan_for(technique, frame, few_samples(technique));
    const RunResult run = gloam::run(plan, frame, device());
    const Computed computed = compute_on_device(plan, frame, caller, suitable(), suitable());
    EXPECT_TRUE(same_bits(run.frame, computed.frame)) << name;
    for (const std::string& copied : computed.enqueued.copied)
      EXPECT_TRUE(copied.find('.') != std::string::npos) << name << " " << copied;
  }
}

TEST(DeviceMemory, TakesACallersPitchAndOffset) {
  const Caller caller;
  Frame frame = shoot(perspective(width, height), room());
  const Plan plan = plan_for(find_technique("gtao"), frame);
  const RunResult run = gloam::run(plan, frame, device());
  const size_t aligned = caller.device.getInfo<CL_DEVICE_MEM_BASE_ADDR_ALIGN>() / 8, guard = 256;
  const Form wide{guard + 3 * aligned, 512, 4, 512 + guard};
  const Computed in_place = compute_on_device(plan, frame, caller, wide, wide);
  EXPECT_TRUE(same_bits(run.frame, in_place.frame));
  EXPECT_EQ(in_place.enqueued.copied, Names());
  const Form tight{4, 4 * width, 4, 4 * width}, of_four{8, 16 * width, 16, 16 * width - 12};
  for (const Form& form : {tight, of_four}) {
    const Computed copied = compute_on_device(plan, frame, caller, form, form);
    EXPECT_TRUE(same_bits(run.frame, copied.frame));
    EXPECT_EQ(copied.enqueued.copied, (Names{"depth", "normal", "ao", "ao_raw"}));
    const Computed mixed = compute_on_device(plan, frame, caller, wide, form);
    EXPECT_TRUE(same_bits(run.frame, mixed.frame));
    EXPECT_EQ(mixed.enqueued.copied, (Names{"ao", "ao_raw"}));
  }
}

/// A table that spans rows and their padding, and memory that an earlier plan wrote.
TEST(DeviceMemory, OfAWidePitchComputesTheSameAgain) {
  const Caller caller;
  const Form wide{256, 384, 4, 384 + 256};
  for (const char* name : {"stereo-ao", "stereo-gtao", "evidence", "sssr"}) {
    const Technique& technique = find_technique(name);
    Frame frame = shoot(perspective(width, height), room());
    const Plan plan = plan_for(technique, frame, few_samples(technique));
    const RunResult run = gloam::run(plan, frame, device());
    Device of_queue = device_of(caller.queue());
    for (int time = 0; time < 3; ++time) {
      const Computed computed = compute_on_device(plan, frame, caller, wide, wide, true, of_queue);
      EXPECT_TRUE(same_bits(run.frame, computed.frame)) << name;
    }
  }
}

/// Pixels that nobody answers for: whatever they are, kernels stay within the planes.
TEST(DeviceMemory, AnyBitsAreSurvived) {
  const Caller caller;
  for (const char* name : {"alchemy", "bilateral", "contact-shadow", "evidence", "indirect", "sd-gtao", "sssr",
                           "stereo-ao", "stereo-ssr", "volumetric"}) {
    const Technique& technique = find_technique(name);
    Frame frame = shoot(perspective(width, height), room());
    const Plan plan = plan_for(technique, frame, few_samples(technique));
    std::mt19937 bits(1);
    for (View& view : frame.views) {
      for (auto& [name, plane] : view.planes) {
        for (Channel& channel : plane.channels) {
          for (int y = 0; y < height; ++y) {
            for (int x = 0; x < width; ++x) {
              if (bits() % 4 == 0) channel.at(x, y) = std::bit_cast<float>(uint32_t(bits()));
              if (bits() % 16 == 0) channel.at(x, y) = std::numeric_limits<float>::quiet_NaN();
            }
          }
        }
      }
    }
    compute_on_device(plan, frame, caller, suitable(), suitable(), false);
  }
}

/// A frame of one view for the failures, on buffers that suit.
class Refusals : public testing::Test {
 protected:
  Refusals() : memory_(caller_, width, height), device_(device_of(caller_.queue())) {
    frame_.width = width;
    frame_.height = height;
    frame_.views = {{"", camera_with_fov(width, height, 60), {}, {}, {}}};
    view().planes = {memory_.plane("depth", suitable()), memory_.plane("normal", suitable())};
    view().results = {memory_.plane("ao", suitable())};
  }

  DeviceView& view() { return frame_.views.front(); }

  std::string refusal() {
    try {
      const Enqueued enqueued = enqueue(plan_, frame_, device_);
      cl::Event(enqueued.done.get(), true).wait();
    } catch (const Error& error) {
      return error.what();
    }
    return "";
  }

  Caller caller_;
  Memory memory_;
  Device device_;
  DeviceFrame frame_;
  const Plan plan_ = make_plan({.outputs = {"gtao"}, .radius = 0.5}, {"depth", "normal"}, "");
};

TEST_F(Refusals, NothingIsWrongAtFirst) { EXPECT_EQ(refusal(), ""); }

TEST_F(Refusals, NameThePlaneAndWhatIsAllowed) {
  view().planes.pop_back();
  EXPECT_EQ(refusal(), "gtao: view '' has no plane 'normal'");
  view().planes.push_back(memory_.plane("normal", suitable()));
  view().planes.push_back(view().planes.front());
  EXPECT_EQ(refusal(), "plane 'depth' of view '': is given twice");
  view().planes.pop_back();
  view().results.front().name = "aoo";
  EXPECT_EQ(refusal(),
            "result 'aoo' of view '': the plan has no such result (did you mean 'ao'?); it has ao and ao_raw");
  view().results.clear();
  view().planes.back().channels.pop_back();
  EXPECT_EQ(refusal(), "plane 'normal' of view '': 2 channels are given; it is made of 3");
}

TEST_F(Refusals, SayWhatDoesNotFit) {
  DeviceChannel& channel = view().planes.front().channels.front();
  const DeviceChannel before = channel;
  channel.offset += 320;
  EXPECT_EQ(refusal(), "plane 'depth' of view '': it ends at byte 8968 of a buffer of 8960");
  channel.offset = size_t(-256);
  EXPECT_NE(refusal().find("it ends behind its buffer of 8960"), std::string::npos) << refusal();
  channel = before;
  channel.offset = 2;
  EXPECT_NE(refusal().find("multiples of 4 are allowed"), std::string::npos) << refusal();
  channel = before;
  view().planes.front().pitch = 100;
  EXPECT_EQ(refusal(), "plane 'depth' of view '': a pitch of 100 bytes is given; a row takes 200");
  view().planes.front().pitch = 256;
  channel.memory = nullptr;
  EXPECT_EQ(refusal(), "plane 'depth' of view '': a channel has no memory; give a cl_mem");
  const Caller other;
  const cl::Buffer foreign = other.buffer(suitable().offset * 2 + suitable().pitch * height);
  channel.memory = foreign();
  EXPECT_EQ(refusal(), "plane 'depth' of view '': its memory is of another context than the queue's");
}

TEST(DeviceMemory, AQueueWithoutOrderIsRefused) {
  const Caller caller(CL_QUEUE_OUT_OF_ORDER_EXEC_MODE_ENABLE);
  if (!caller.queue()) GTEST_SKIP() << "this driver has no such queues";
  try {
    device_of(caller.queue());
    FAIL() << "it was taken";
  } catch (const Error& error) {
    EXPECT_NE(std::string(error.what()).find("runs commands out of order"), std::string::npos) << error.what();
  }
}

/// multiview makes AO for the first view alone.
TEST_F(Refusals, NameAResultThatNoPassMakes) {
  const Plan plan = make_plan({.outputs = {"multiview"}, .settings = {{"samples", "1"}}, .radius = 0.5},
                              {"depth", "normal", "stochastic.00"}, "");
  view().planes.clear();
  for (const std::string& name : plan.inputs) view().planes.push_back(memory_.plane(name, suitable()));
  frame_.views.push_back(frame_.views.front());
  frame_.views[0].name = "first", frame_.views[1].name = "second";
  frame_.views[0].camera->pose = frame_.views[1].camera->pose = Pose{};
  try {
    enqueue(plan, frame_, device_);
    FAIL() << "it was taken";
  } catch (const Error& error) {
    EXPECT_STREQ(error.what(), "result 'ao' of view 'second': no pass makes it in this view; leave it out");
  }
  frame_.views[1].results.clear();
  EXPECT_NO_THROW(enqueue(plan, frame_, device_));
  caller_.queue.finish();
}

/// The queue may wait for the caller, who waits for the call.
TEST_F(Refusals, DoNotWaitForTheQueue) {
  view().planes.pop_back();
  const Plan plan = make_plan({.outputs = {"normals"}}, {"depth"}, "");
  view().results = {memory_.plane("normal", suitable())};
  cl::UserEvent go(caller_.context);
  enqueue(plan, frame_, device_, {}, {go()});
  frame_.views.push_back(frame_.views.front());
  frame_.views.back().results.front().name = "ao";
  EXPECT_THROW(enqueue(plan, frame_, device_, {}, {go()}), Error);
  go.setStatus(CL_COMPLETE);
  caller_.queue.finish();
}

TEST_F(Refusals, OfMemoryThatKernelsMayNotUse) {
  const size_t bytes = device_layout(width, height).bytes;
  const cl::Buffer unwritable(caller_.context, CL_MEM_READ_ONLY, bytes),
      unreadable(caller_.context, CL_MEM_WRITE_ONLY, bytes);
  view().results.front().channels.front().memory = unwritable();
  EXPECT_EQ(refusal(), "result 'ao' of view '': kernels may not write its memory (CL_MEM_READ_ONLY)");
  view().results.clear();
  view().planes.front().channels.front().memory = unreadable();
  EXPECT_EQ(refusal(), "plane 'depth' of view '': kernels may not read its memory (CL_MEM_WRITE_ONLY)");
}

/// Three planes side by side in one buffer that is only read.
TEST_F(Refusals, DoNotMeetPartsOfOneBuffer) {
  const DeviceLayout layout = device_layout(width, height);
  const size_t aligned = (layout.bytes + 4095) / 4096 * 4096;
  const cl::Buffer all(caller_.context, CL_MEM_READ_ONLY, 3 * aligned);
  DevicePlane& normal = view().planes.back();
  for (size_t i = 0; i < 3; ++i) normal.channels[i] = {all(), layout.offset + i * aligned, 4};
  normal.is_clean = true;
  EXPECT_EQ(refusal(), "");
}

TEST_F(Refusals, LeaveTheDeviceUsable) {
  view().results.front().name = "no such";
  EXPECT_NE(refusal(), "");
  view().results.front().name = "ao";
  EXPECT_EQ(refusal(), "");
}

/// Memory is taken again while the plan before still computes in it.
TEST(DeviceMemory, PlansOneAfterAnotherDoNotDisturbOneAnother) {
  const Caller caller;
  Device of_queue = device_of(caller.queue());
  Frame frame = shoot(perspective(width, height), room());
  std::vector<Plan> plans;
  for (const char* name : {"evidence", "sd-hbao+", "indirect", "gtao"})
    plans.push_back(plan_for(find_technique(name), frame, few_samples(find_technique(name))));
  struct Under {
    DeviceFrame given;
    Enqueued enqueued;
  };
  Memory memory(caller, width, height);
  std::vector<Under> all;
  for (int round = 0; round < 3; ++round) {
    for (const Plan& plan : plans) {
      const View& view = frame.views.front();
      Under& under = all.emplace_back(Under{{width, height, {{view.name, view.camera, {}, {}, {}}}}, {}});
      for (const std::string& name : plan.inputs) {
        under.given.views[0].planes.push_back(memory.plane(name, suitable()));
        memory.write(under.given.views[0].planes.back(), *view.find(name));
      }
      for (const std::string& name : plan.outputs)
        under.given.views[0].results.push_back(memory.plane(name, suitable()));
    }
  }
  for (size_t i = 0; i < all.size(); ++i) all[i].enqueued = enqueue(plans[i % plans.size()], all[i].given, of_queue);
  caller.queue.finish();
  for (size_t i = 0; i < all.size(); ++i) {
    const Frame expected = gloam::run(plans[i % plans.size()], frame, device()).frame;
    Frame computed = without_planes(frame);
    for (const DevicePlane& result : all[i].given.views[0].results)
      computed.views[0].planes[result.name] = memory.read(result);
    EXPECT_TRUE(same_bits(expected, computed)) << i;
  }
}

TEST(DeviceMemory, BeginsNothingBeforeTheEventsThatItWaitsFor) {
  const Caller caller;
  Memory memory(caller, width, height);
  Device device = device_of(caller.queue());
  const Plan plan = make_plan({.outputs = {"normals"}}, {"depth"}, "");
  DeviceFrame frame{width,
                    height,
                    {{"",
                      camera_with_fov(width, height, 60),
                      {},
                      {memory.plane("depth", suitable())},
                      {memory.plane("normal", suitable())}}}};
  cl::UserEvent go(caller.context);
  const Enqueued enqueued = enqueue(plan, frame, device, {}, {go()});
  cl::Event done(enqueued.done.get(), true);
  EXPECT_NE(done.getInfo<CL_EVENT_COMMAND_EXECUTION_STATUS>(), CL_COMPLETE);
  go.setStatus(CL_COMPLETE);
  done.wait();
  EXPECT_EQ(done.getInfo<CL_EVENT_COMMAND_EXECUTION_STATUS>(), CL_COMPLETE);
}

/// A device of a caller's queue also runs plans on frames of the host.
TEST(DeviceMemory, ACallersQueueRunsFramesToo) {
  const Caller caller;
  Device of_queue = device_of(caller.queue());
  Frame frame = shoot(perspective(width, height), room());
  const Plan plan = plan_for(find_technique("gtao"), frame);
  const RunResult run = gloam::run(plan, frame, of_queue);
  EXPECT_TRUE(same_bits(gloam::run(plan, frame, device()).frame, run.frame));
  EXPECT_GT(run.total_ms.front(), 0);
}

}  // namespace
}  // namespace gloam::test::device_memory_test
