// A small report, measured and written: its numbers parse and are finite, its links lead somewhere.
#include <alpenglow/cost.h>
#include <alpenglow/io/file.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <regex>
#include <sstream>

#include "tests/io/temporary_folder.h"

namespace alpenglow::cost {
namespace {

namespace fs = std::filesystem;

std::string contentOf(const fs::path& path) {
  const auto text = io::readFile(path.string(), 64 << 20);
  EXPECT_TRUE(text) << text.error;
  return text ? *text : std::string();
}

/// Fields of a line of CSV.
std::vector<std::string> fieldsOf(const std::string& line) {
  std::vector<std::string> fields(1);
  bool quoted = false;
  for (const char c : line) {
    if (c == '"') {
      quoted = !quoted;
    } else if (c == ',' && !quoted) {
      fields.emplace_back();
    } else {
      fields.back() += c;
    }
  }
  return fields;
}

Options smallOptions() {
  Options options;
  options.quick = true;
  options.truthFolder = ALPENGLOW_TRUTH_FOLDER;
  options.command = "test";
  options.validation = true;
  options.width = 160;
  options.height = 90;
  options.only = [](const std::string& name) {
    return name == "model/single (moments)" || name == "model/oneil 10" ||
           name == "quality/draft" || name == "quality/draft, planned" ||
           name == "storage/moments, shared exponent" || name == "domain/one evening sun";
  };
  return options;
}

TEST(Report, IsWholeAndItsNumbersAreFinite) {
  const auto report = measure(smallOptions());
  ASSERT_TRUE(report) << report.error;
  ASSERT_EQ(report->rows.size(), 6u);
  for (const Row& row : report->rows) {
    EXPECT_TRUE(row.measured()) << row.name << ": " << row.note;
    EXPECT_GT(row.bytes, 0u) << row.name;
    EXPECT_GE(row.peakBytes, row.bytes) << row.name;
    EXPECT_LT(row.peakBytes, uint64_t{1} << 30) << row.name;
    EXPECT_GE(row.bake_s.median, 0.0) << row.name;
    EXPECT_GT(row.groundFrame_ms(), 0.0) << row.name;
    EXPECT_GT(row.errors[1].rays, 5u) << row.name;  // a low sun, which all have
    for (const BandError& error : row.errors) {
      EXPECT_TRUE(std::isfinite(error.p95) && std::isfinite(error.most)) << row.name;
      EXPECT_LE(error.p95, error.most) << row.name;
    }
  }
  // Single scattering alone is far off; a draft is not.
  EXPECT_GT(report->rows[0].errors[0].p95, 0.2);
  EXPECT_LT(report->rows[2].errors[0].p95, 0.03);

  const test::TemporaryFolder folder;
  const fs::path to = fs::path(folder.path()) / "report";
  ASSERT_TRUE(writeReport(*report, to.string()));
  std::istringstream csv(contentOf(to / "cost.csv"));
  std::string line;
  std::getline(csv, line);
  const auto names = fieldsOf(line);
  size_t rows = 0;
  for (; std::getline(csv, line); ++rows) {
    const auto fields = fieldsOf(line);
    ASSERT_EQ(fields.size(), names.size()) << line;
    for (size_t i = 5; i < fields.size(); ++i) {
      if (fields[i].empty()) continue;
      char* end = nullptr;
      EXPECT_TRUE(std::isfinite(std::strtod(fields[i].c_str(), &end))) << names[i];
      EXPECT_EQ(*end, '\0') << names[i] << " " << fields[i];
    }
  }
  EXPECT_EQ(rows, report->rows.size());

  const std::string page = contentOf(to / "index.html");
  EXPECT_NE(page.find("</html>"), std::string::npos);
  const std::regex link("(?:src|href)=\"([^\"#]+)\"");
  size_t links = 0;
  for (std::sregex_iterator it(page.begin(), page.end(), link), none; it != none; ++it, ++links)
    EXPECT_TRUE(fs::is_regular_file(to / (*it)[1].str())) << (*it)[1];
  EXPECT_GT(links, 10u);
  EXPECT_EQ(contentOf(to / "error_frame_day.png").substr(1, 3), "PNG");
  EXPECT_NE(contentOf(to / "error_frame_day.svg").find("<svg"), std::string::npos);
}

TEST(Report, SaysWhyItCanNotBeWrittenOrMeasured) {
  const test::TemporaryFolder folder;
  const std::string file = (fs::path(folder.path()) / "file").string();
  ASSERT_TRUE(io::writeFile(file, "x", 1));
  const io::Done done = prepareFolder(file);
  EXPECT_FALSE(done);
  EXPECT_EQ(done.error, "The folder '" + file + "' can't be made: a file is in its place.");
  const io::Done below = prepareFolder(file + "/below");
  EXPECT_EQ(below.error, "The folder '" + file + "/below' can't be made: Not a directory.");
  Options options = smallOptions();
  options.truthFolder = folder.path();
  const auto none = measure(options);
  EXPECT_FALSE(none);
  EXPECT_NE(none.error.find("earth"), std::string::npos) << none.error;
}

}  // namespace
}  // namespace alpenglow::cost
