#include "modules/render/contact_sheet.hpp"

#include <gtest/gtest.h>

#include <atomic>
#include <thread>

#include "modules/render/snapshot.hpp"
#include "tests/unit/render/pictures.hpp"

namespace atrium::render::contact_sheet_test {
namespace {

Inputs<Pictures> grey(int count, int width = 200, int height = 100) {
  Pictures pictures;
  for (int i = 0; i < count; ++i)
    pictures.pictures.push_back(
        {width, height, "a", std::vector<std::uint8_t>(3UL * static_cast<std::size_t>(width * height), 200)});
  return {input(pictures)};
}

Picture sheet(const Inputs<Pictures>& pictures, const ContactSheet::Params& params) {
  Context context(1, std::make_shared<Folder>());
  return ContactSheet::run({pictures}, params, context).sheet.pictures.at(0);
}

std::string problem(const Inputs<Pictures>& pictures, const ContactSheet::Params& params) {
  try {
    sheet(pictures, params);
  } catch (const Error& error) {
    return error.what();
  }
  return "";
}

/// The columns that are darker than paper and pictures.
std::pair<int, int> written_columns(const Picture& picture) {
  std::pair<int, int> found{picture.width, -1};
  for (int y = 0; y < picture.height; ++y)
    for (int x = 0; x < picture.width; ++x)
      if (picture.pixels[3 * (static_cast<std::size_t>(y) * picture.width + x)] < 120)
        found = {std::min(found.first, x), std::max(found.second, x)};
  return found;
}

TEST(ContactSheetNode, CutsCaptionsToTheirCells) {
  ContactSheet::Params params;
  params.cell_width = 200;
  params.caption_size = 0.08;
  params.captions = {"a caption that is much longer than its picture is wide: ä ö ü … and so on", ""};
  const Picture two = sheet(grey(2), params);
  const auto [left, right] = written_columns(two);
  EXPECT_GE(left, 12);
  EXPECT_LT(right, 12 + 200) << "it does not run into the next cell";
  EXPECT_GT(right, 12 + 180) << "it fills its cell";
  params.captions = {"short\nlines", ""};
  const Picture lines = sheet(grey(2), params);
  params.captions = {"short lines", ""};
  EXPECT_EQ(lines.pixels, sheet(grey(2), params).pixels) << "one line";
}

TEST(ContactSheetNode, ATooLargeSheetIsAnErrorBeforeItIsMade) {
  ContactSheet::Params params;
  params.cell_width = 4096;
  EXPECT_NE(problem(grey(200), params).find("more than 100 million"), std::string::npos);
  EXPECT_NE(problem(grey(1, 1, 60000), params).find("more than 100 million"), std::string::npos);
  params.cell_width = 64;
  EXPECT_EQ(problem(grey(200), params), "");
}

TEST(ContactSheetNode, PicturesAreFilesThatEndInPng) {
  for (const char* name : {"sheet.jpg", "sheet", "sheet.png.bak"}) {
    ContactSheet::Params params;
    params.path.path = name;
    EXPECT_NE(problem(grey(1), params).find("must end in .png"), std::string::npos) << name;
    Context context(1, std::make_shared<Folder>());
    Snapshot::Params snapshot;
    snapshot.path.path = name;
    EXPECT_THROW(Snapshot::run({.mesh = input(square(Eigen::Vector3d::Zero()))}, snapshot, context), Error) << name;
  }
  Context context(1, std::make_shared<Folder>());
  Snapshot::Params twice;
  twice.views = {"top", "isometric", "top"};
  EXPECT_THROW(Snapshot::run({.mesh = input(square(Eigen::Vector3d::Zero()))}, twice, context), Error);
}

TEST(ContactSheetNode, ManyAtATimeGetTheSameLetters) {
  const auto host = std::make_shared<Folder>();
  ContactSheet::Params params;
  params.cell_width = 400;
  const auto make = [&](int size) {
    ContactSheet::Params own = params;
    own.path.path = "sheet" + std::to_string(size) + ".png";
    own.caption_size = 0.02 + 0.001 * size;
    own.captions = {"caption abcdefghijklmnop", "QRSTUVWXYZ 0123456789 äöü"};
    Context context(1, host);
    return ContactSheet::run({grey(2)}, own, context).sheet.pictures.at(0).pixels;
  };
  constexpr int sizes = 24;
  std::vector<std::vector<std::uint8_t>> together(sizes);
  std::vector<std::thread> threads;
  std::atomic<int> next{0};
  for (int t = 0; t < 4; ++t)
    threads.emplace_back([&] {
      for (int i = next++; i < sizes; i = next++) together[static_cast<std::size_t>(i)] = make(i);
    });
  for (auto& thread : threads) thread.join();
  for (int i = 0; i < sizes; ++i) EXPECT_EQ(together[static_cast<std::size_t>(i)], make(i)) << i;
}

}  // namespace
}  // namespace atrium::render::contact_sheet_test
