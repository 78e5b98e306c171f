#include <gtest/gtest.h>
#include <sys/resource.h>
#include <sys/stat.h>

#include <csignal>

#include "burnish/io/atomic_writer.h"
#include "burnish/io/file.h"
#include "samples.h"

namespace burnish {
namespace {
namespace fs = std::filesystem;

TEST(ReadFile, MapsTheBytes) {
  const test::TemporaryFolder folder;
  ASSERT_TRUE(write_file(folder / "a", std::string("one\0two", 7)));
  const auto file = read_file(folder / "a");
  ASSERT_TRUE(file);
  EXPECT_EQ(file->text(), std::string("one\0two", 7));
  ASSERT_TRUE(write_file(folder / "empty", ""));
  EXPECT_EQ(read_file(folder / "empty")->size(), 0u);
}

TEST(ReadFile, NamesTheFileInErrors) {
  const test::TemporaryFolder folder;
  EXPECT_EQ(read_file(folder.path()).error().code, ErrorCode::unsupported);
  EXPECT_EQ(read_file("/dev/null").error().code, ErrorCode::unsupported);
  ASSERT_EQ(::mkfifo((folder / "pipe").c_str(), 0600), 0);
  EXPECT_EQ(read_file(folder / "pipe").error().code, ErrorCode::unsupported);
  const auto missing = read_file(folder / "nothing");
  ASSERT_FALSE(missing);
  EXPECT_EQ(missing.error().code, ErrorCode::not_found);
  EXPECT_EQ(missing.error().where, (folder / "nothing").string());
}

TEST(AtomicWriter, LeavesTheOldFileUntilTheCommit) {
  const test::TemporaryFolder folder;
  const fs::path path = folder / "file";
  ASSERT_TRUE(write_file(path, "old"));
  {
    auto writer = AtomicWriter::create(path);
    ASSERT_TRUE(writer);
    ASSERT_TRUE(writer->write("new"));
    EXPECT_EQ(test::slurp(path), "old");
  }
  EXPECT_EQ(test::slurp(path), "old");
  EXPECT_EQ(std::distance(fs::directory_iterator(folder.path()), {}), 1);
  auto writer = AtomicWriter::create(path);
  ASSERT_TRUE(writer);
  ASSERT_TRUE(writer->write("new"));
  ASSERT_TRUE(writer->commit());
  EXPECT_EQ(test::slurp(path), "new");
  EXPECT_EQ(std::distance(fs::directory_iterator(folder.path()), {}), 1);
}

TEST(AtomicWriter, KeepsPermissionsAndFollowsLinks) {
  const test::TemporaryFolder folder;
  const fs::path path = folder / "file";
  ASSERT_TRUE(write_file(path, "old"));
  fs::permissions(path, fs::perms::owner_read | fs::perms::owner_write);
  fs::create_symlink(path, folder / "link");
  ASSERT_TRUE(write_file(folder / "link", "new"));
  EXPECT_TRUE(fs::is_symlink(folder / "link"));
  EXPECT_EQ(test::slurp(path), "new");
  EXPECT_EQ(fs::status(path).permissions(), fs::perms::owner_read | fs::perms::owner_write);
}

TEST(AtomicWriter, RefusesFoldersDevicesAndMissingFolders) {
  const test::TemporaryFolder folder;
  EXPECT_EQ(AtomicWriter::create(folder.path()).error().code, ErrorCode::unsupported);
  EXPECT_EQ(AtomicWriter::create("/dev/null").error().code, ErrorCode::unsupported);
  EXPECT_EQ(AtomicWriter::create(folder / "none/file").error().code, ErrorCode::not_found);
}

TEST(AtomicWriter, ReportsWhatTheSystemRefuses) {
  const test::TemporaryFolder folder;
  struct rlimit before {};
  ASSERT_EQ(::getrlimit(RLIMIT_FSIZE, &before), 0);
  const auto old_handler = std::signal(SIGXFSZ, SIG_IGN);
  struct rlimit small = before;
  small.rlim_cur = 100;
  ASSERT_EQ(::setrlimit(RLIMIT_FSIZE, &small), 0);
  const auto written = write_file(folder / "file", std::string(1000, 'x'));
  ASSERT_EQ(::setrlimit(RLIMIT_FSIZE, &before), 0);
  std::signal(SIGXFSZ, old_handler);
  ASSERT_FALSE(written);
  EXPECT_EQ(written.error().code, ErrorCode::io_failure);
  EXPECT_TRUE(fs::is_empty(folder.path()));
}

}  // namespace
}  // namespace burnish
