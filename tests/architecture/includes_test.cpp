#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <map>
#include <regex>
#include <set>
#include <sstream>
#include <string>
#include <vector>

#include "support/test_data.h"

// The house as docs/architecture.md has it: its table against what the sources include and link.
namespace burnish {
namespace {
namespace fs = std::filesystem;

const fs::path kRoot = test::source_folder();
const fs::path kModules = kRoot / "src" / "burnish";

using Rules = std::map<std::string, std::set<std::string>>;

std::vector<std::string> lines(const fs::path& path) {
  std::ifstream file(path);
  std::vector<std::string> result;
  for (std::string line; std::getline(file, line);) result.push_back(line);
  return result;
}

/// Rows of the form "| 1 | core | base | what it is for |".
Rules rules() {
  static const std::regex row(R"(\| \d \| (\w+) \| ([\w, -]+) \|.*)");
  Rules result;
  for (const std::string& line : lines(kRoot / "docs" / "architecture.md")) {
    std::smatch cells;
    if (!std::regex_match(line, cells, row)) continue;
    std::set<std::string>& allowed = result[cells[1]];
    std::stringstream names(cells[2]);
    for (std::string name; std::getline(names >> std::ws, name, ',');) {
      if (name != "-") allowed.insert(name);
    }
  }
  return result;
}

std::set<std::string> folders(const fs::path& parent) {
  std::set<std::string> result;
  for (const auto& entry : fs::directory_iterator(parent)) {
    if (entry.is_directory()) result.insert(entry.path().filename());
  }
  return result;
}

std::set<fs::path> files(const fs::path& folder, const std::set<std::string>& extensions) {
  std::set<fs::path> result;
  for (const auto& entry : fs::recursive_directory_iterator(folder)) {
    if (extensions.count(entry.path().extension())) result.insert(entry.path());
  }
  return result;
}

/// What stands between quotes or angle brackets after #include.
std::vector<std::string> includes(const fs::path& path) {
  static const std::regex include(R"(\s*#\s*include\s*["<]([^">]+)[">].*)");
  std::vector<std::string> result;
  for (const std::string& line : lines(path)) {
    std::smatch match;
    if (std::regex_match(line, match, include)) result.push_back(match[1]);
  }
  return result;
}

TEST(Architecture, TheTableNamesTheModulesThatThereAre) {
  std::set<std::string> named;
  for (const auto& [module, allowed] : rules()) {
    named.insert(module);
    for (const std::string& other : allowed)
      EXPECT_TRUE(rules().count(other)) << module << ": " << other;
  }
  EXPECT_EQ(named, folders(kModules));
}

TEST(Architecture, TheTableHasNoCircles) {
  // Modules can be taken away one after the other, each when nothing that it needs is left.
  Rules left = rules();
  for (bool found = true; found && !left.empty();) {
    found = false;
    for (auto rule = left.begin(); rule != left.end();) {
      bool free = true;
      for (const std::string& other : rule->second) free = free && !left.count(other);
      found = found || free;
      rule = free ? left.erase(rule) : std::next(rule);
    }
  }
  EXPECT_TRUE(left.empty());
}

TEST(Architecture, ModulesIncludeOnlyWhatTheirRowNames) {
  const Rules allowed = rules();
  std::size_t seen = 0;
  for (const auto& [module, others] : allowed) {
    for (const fs::path& file : files(kModules / module, {".h", ".cpp"})) {
      for (const std::string& name : includes(file)) {
        if (name.rfind("burnish/", 0) != 0) continue;
        const std::string other = name.substr(8, name.find('/', 8) - 8);
        EXPECT_TRUE(other == module || others.count(other)) << file << " includes " << name;
        ++seen;
      }
    }
  }
  EXPECT_GT(seen, 50u);
}

TEST(Architecture, TargetsLinkOnlyWhatTheirRowNames) {
  static const std::regex uses(
      R"(burnish_module\((\w+) USES ([\w ]+?)( PRIVATE .*| PUBLIC .*|\)))");
  std::size_t seen = 0;
  for (const auto& [module, others] : rules()) {
    for (const std::string& line : lines(kModules / module / "CMakeLists.txt")) {
      std::smatch match;
      if (!std::regex_match(line, match, uses)) continue;
      EXPECT_EQ(match[1], module);
      std::stringstream names(match[2]);
      for (std::string other; names >> other; ++seen) {
        EXPECT_TRUE(others.count(other)) << module << " links " << other;
      }
    }
  }
  EXPECT_GT(seen, 20u);
}

TEST(Architecture, HeadersKeepThirdPartiesToThemselves) {
  static const std::regex third_party(
      R"((Eigen|embree3?|tbb|oneapi|fmt|nlohmann|CLI)/.*|png\.h|zlib\.h|tiff.*\.h)");
  EXPECT_TRUE(std::regex_match("Eigen/Dense", third_party));
  for (const fs::path& file : files(kModules, {".h"})) {
    for (const std::string& name : includes(file)) {
      EXPECT_FALSE(std::regex_match(name, third_party)) << file << " includes " << name;
    }
  }
}

TEST(Architecture, HeadersAreGuarded) {
  for (const fs::path& file : files(kModules, {".h"})) {
    EXPECT_EQ(lines(file).front(), "#pragma once") << file;
  }
}

/// So that a header that leans on what others include does not compile.
TEST(Architecture, SourcesIncludeTheirOwnHeaderFirst) {
  for (const fs::path& source : files(kModules, {".cpp"})) {
    fs::path header = source;
    header.replace_extension(".h");
    if (!fs::exists(header)) continue;
    const std::vector<std::string> text = lines(source);
    const auto first = std::find_if(text.begin(), text.end(), [](const std::string& line) {
      return line.rfind("#include", 0) == 0;
    });
    ASSERT_NE(first, text.end()) << source;
    EXPECT_EQ(*first, "#include \"" + fs::relative(header, kRoot / "src").string() + "\"")
        << source;
  }
}

TEST(Architecture, TestsMirrorTheModules) {
  std::set<std::string> expected = folders(kModules);
  expected.insert(
      {"allocation", "app", "architecture", "conformance", "oracle", "package", "support"});
  for (const std::string& folder : folders(kRoot / "tests")) {
    EXPECT_TRUE(expected.count(folder)) << "tests/" << folder << " mirrors no module";
  }
  for (const std::string& module : folders(kModules)) {
    const fs::path tests = kRoot / "tests" / module;
    ASSERT_TRUE(fs::is_directory(tests)) << module << " has no tests";
    EXPECT_FALSE(files(tests, {".cpp"}).empty()) << module << " has no tests";
  }
}

}  // namespace
}  // namespace burnish
