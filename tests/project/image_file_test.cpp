#include "project/image_file.h"

#include <cmath>

#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

#include "base/errors.h"
#include "project/npy.h"
#include "tests/support/temporary_folder.h"

namespace tetraglass::project {
namespace {

Image gradient_image(int width, int height) {
  Image image(width, height);
  for (std::size_t i = 0; i < image.rgba.size(); ++i) {
    image.rgba[i] = static_cast<float>(i) / static_cast<float>(image.rgba.size());
  }
  return image;
}

TEST(ImageFile, FloatFormatsKeepEveryBit) {
  const tests::TemporaryFolder folder;
  Image image = gradient_image(7, 5);
  image.rgba[3] = -1e30F;
  image.rgba[4] = 1e-40F;
  for (const std::string name : {"a.exr", "a.npy", "A.NPY"}) {
    write_image(image, folder.file(name));
    const ReadImage back = read_image(folder.file(name));
    EXPECT_FALSE(back.encoded);
    EXPECT_EQ(back.image.width, 7);
    EXPECT_EQ(back.image.height, 5);
    EXPECT_EQ(back.image.rgba, image.rgba) << name;
  }
}

TEST(ImageFile, PngIsCompositedOverTheBackgroundAndEncoded) {
  const tests::TemporaryFolder folder;
  Image image(2, 1);
  image.pixel(0, 0)[0] = 0.25F;  // half covered, premultiplied
  image.pixel(0, 0)[3] = 0.5F;
  Background background;
  background.rgb = {0, 1, 0.5};
  write_image(image, folder.file("a.png"), background);
  const ReadImage back = read_image(folder.file("a.png"));
  ASSERT_TRUE(back.encoded);
  constexpr double kStep = 0.5 / 255 + 1e-6;
  EXPECT_NEAR(back.image.pixel(0, 0)[0], srgb_encode(0.25), kStep);
  EXPECT_NEAR(back.image.pixel(0, 0)[1], srgb_encode(0.5), kStep);
  EXPECT_NEAR(back.image.pixel(0, 0)[2], srgb_encode(0.25), kStep);
  EXPECT_NEAR(back.image.pixel(1, 0)[2], srgb_encode(0.5), kStep);
  EXPECT_EQ(back.image.pixel(0, 0)[3], 1);
}

TEST(ImageFile, CountsWhatEightBitsCannotHold) {
  const tests::TemporaryFolder folder;
  Image image(3, 1);
  image.pixel(1, 0)[1] = 2;
  image.pixel(2, 0)[1] = 1;
  EXPECT_EQ(write_image(image, folder.file("a.png")).clipped_pixels, 1U);
  EXPECT_EQ(write_image(image, folder.file("a.exr")).clipped_pixels, 0U);
}

TEST(ImageFile, SrgbCurveInvertsItself) {
  for (int i = 0; i <= 1000; ++i)
    EXPECT_NEAR(srgb_decode(srgb_encode(i / 1000.0)), i / 1000.0, 1e-12);
}

TEST(ImageFile, LeavesNothingBehindOnFailure) {
  const tests::TemporaryFolder folder;
  EXPECT_THROW(write_image(Image(2, 2), folder.file("a.jpg")), base::WriteError);
  EXPECT_THROW(write_image(Image(2, 2), folder.file("none/a.png")), base::WriteError);
  EXPECT_TRUE(folder.is_empty());
}

TEST(ImageFile, RefusesBrokenFiles) {
  const tests::TemporaryFolder folder;
  EXPECT_THROW((void)read_image(folder.file("missing.png")), base::ReadError);
  for (const std::string name : {"a.png", "a.exr", "a.npy"}) {
    write_image(gradient_image(9, 9), folder.file(name));
    const std::string whole = tests::read_text(folder.file(name));
    for (const std::size_t size :
         {std::size_t{0}, std::size_t{5}, whole.size() / 2, whole.size() - 1}) {
      tests::write_text(folder.file(name), whole.substr(0, size));
      // A .png without its last byte is still whole: the end mark's checksum is not needed.
      if (name == "a.png" && size == whole.size() - 1) continue;
      EXPECT_THROW((void)read_image(folder.file(name)), base::ReadError)
          << name << " cut to " << size;
    }
  }
}

TEST(Npy, RefusesAShapeThatLies) {
  const std::vector<std::size_t> shape = {1000000000, 1000000000, 1000000000};
  EXPECT_THROW((void)parse_npy(to_npy(shape, {}), "lie.npy"), base::ReadError);
}

}  // namespace
}  // namespace tetraglass::project
