// Recordings in, as a user meets them.
#include "app/program.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "support/test_data.h"

namespace burnish {
namespace {

namespace fs = std::filesystem;
using test::burnish;
using test::bytes_of;
using test::Outcome;
using test::TemporaryFolder;

/// A KLG of plain depth images, 640 x 480, of 1 m.
void write_klg(const fs::path& path, std::int32_t frames) {
  std::ofstream file(path, std::ios::binary);
  const auto put = [&](auto value) {
    file.write(reinterpret_cast<const char*>(&value), sizeof(value));
  };
  const std::vector<std::uint16_t> depth(640 * 480, 1000);
  put(frames);
  for (std::int64_t i = 0; i < frames; ++i) {
    put(i * 33333);
    put(static_cast<std::int32_t>(2 * depth.size()));
    put(std::int32_t{0});
    file.write(reinterpret_cast<const char*>(depth.data()),
               static_cast<std::streamsize>(2 * depth.size()));
  }
}

TEST(ImportVerb, GivesFramesOfWhichTheSameMeshComes) {
  const TemporaryFolder folder;
  const std::string scan = folder / "scan", frames = folder / "frames";
  ASSERT_EQ(burnish({"simulate", "sphere", "-o", scan, "--views", "2"}).status, 0);
  const Outcome imported = burnish({"import", scan, "-o", frames});
  ASSERT_EQ(imported.status, 0) << imported.err;
  EXPECT_NE(imported.out.find("posed_frames: 2"), std::string::npos) << imported.out;
  for (const std::string& input : {scan, frames}) {
    const Outcome made = burnish({"reconstruct", input, "-o", input + ".ply"});
    ASSERT_EQ(made.status, 0) << made.err;
  }
  EXPECT_EQ(bytes_of(frames + ".ply"), bytes_of(scan + ".ply"));
}

TEST(ImportVerb, SaysWhatItReadsAndRefusesWhatItDoesNot) {
  const TemporaryFolder folder;
  const Outcome help = burnish({"import", "--help"});
  for (const char* format : {"oni", "azure", "pclzf", "klg", "fakenect", "tum", "images"})
    EXPECT_NE(help.out.find(std::string("\n  ") + format + " "), std::string::npos) << format;
  std::ofstream(folder / "cut.klg") << "abc";
  const Outcome cut = burnish({"import", folder / "cut.klg", "-o", folder / "out"});
  EXPECT_EQ(cut.status, 4);
  EXPECT_NE(cut.err.find("cut.klg, byte 0: the file ends"), std::string::npos) << cut.err;
  EXPECT_FALSE(fs::exists(folder / "out"));
  EXPECT_EQ(burnish({"import", folder / "cut.klg", "-o", folder / "out", "--every", "0"}).status,
            2);
}

TEST(ImportVerb, InterruptLeavesNoHalfFolder) {
  const TemporaryFolder folder;
  write_klg(folder / "log", 150);  // about half a second's work
  const Outcome outcome = burnish({"import", folder / "log", "-o", folder / "out"}, 60);
  EXPECT_EQ(outcome.status, 130) << outcome.err;
  EXPECT_LT(outcome.seconds, 2.0);
  EXPECT_FALSE(fs::exists(folder / "out"));
}

}  // namespace
}  // namespace burnish
