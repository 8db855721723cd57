// Device memory that is kept from run to run.
#include "run/buffer_pool.h"

#include <gtest/gtest.h>

#include <limits>

namespace gloam::test::buffer_pool_test {
namespace {

class Pool : public testing::Test {
 protected:
  bool takes_new(size_t bytes, float content) {
    BufferPool::Taken taken = pool_.take(context_, bytes, content);
    pool_.give(taken.buffer, bytes, content);
    return taken.is_new;
  }

  const cl::Context context_{cl::Device::getDefault()};
  BufferPool pool_;
};

TEST_F(Pool, GivesAgainWhatHasTheSameSizeAndContent) {
  constexpr float any = std::numeric_limits<float>::quiet_NaN();
  EXPECT_TRUE(takes_new(4096, 1));
  EXPECT_FALSE(takes_new(4096, 1));
  EXPECT_TRUE(takes_new(8192, 1));
  EXPECT_TRUE(takes_new(4096, 0));
  EXPECT_TRUE(takes_new(4096, any));
  EXPECT_FALSE(takes_new(4096, any));
  EXPECT_EQ(pool_.bytes(), 4096u * 3 + 8192);
}

TEST_F(Pool, GivesNothingTwice) {
  EXPECT_TRUE(takes_new(4096, 1));
  const BufferPool::Taken one = pool_.take(context_, 4096, 1), other = pool_.take(context_, 4096, 1);
  EXPECT_FALSE(one.is_new);
  EXPECT_TRUE(other.is_new);
  EXPECT_NE(one.buffer(), other.buffer());
}

TEST_F(Pool, LetsGoOfWhatTheLastRunsDidNotUse) {
  EXPECT_TRUE(takes_new(4096, 1));
  for (int run = 0; run < 8; ++run) pool_.begin_run(0, 1 << 20);
  EXPECT_EQ(pool_.bytes(), 4096u);
  pool_.begin_run(0, 1 << 20);
  EXPECT_EQ(pool_.bytes(), 0u);
}

/// One run needed four; those after it need one, and do not keep the others by taking turns with them.
TEST_F(Pool, LetsGoOfWhatIsTooMany) {
  for (int i = 0; i < 4; ++i) pool_.give(cl::Buffer(context_, CL_MEM_READ_WRITE, 4096), 4096, 1);
  for (int run = 0; run < 9; ++run) {
    pool_.begin_run(0, 1 << 20);
    EXPECT_FALSE(takes_new(4096, 1));
  }
  EXPECT_EQ(pool_.bytes(), 4096u);
}

TEST_F(Pool, MakesRoomForARunThatNeedsTheMemory) {
  EXPECT_TRUE(takes_new(4096, 1));
  pool_.begin_run(4096, 8192);
  EXPECT_EQ(pool_.bytes(), 4096u);
  pool_.begin_run(8000, 8192);
  EXPECT_EQ(pool_.bytes(), 0u);
}

}  // namespace
}  // namespace gloam::test::buffer_pool_test
