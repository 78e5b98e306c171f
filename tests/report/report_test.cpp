#include "burnish/report/report.h"

#include <gtest/gtest.h>

#include <fstream>
#include <sstream>

#include "burnish/shapes/shapes.h"
#include "report/well_formed.h"
#include "support/test_data.h"

namespace burnish {
namespace {

namespace fs = std::filesystem;

/// Three phases with everything that a record can hold.
Record full_record() {
  Record record;
  record.title = "A <b>sphere</b> & \"more\"";
  record.command = "burnish smooth 'a b.ply' -o \xff.ply";
  record.inputs = {"<script>alert(1)</script>.ply"};
  record.steps = {{"smooth",
                   "one_ring_mean",
                   {{"iterations", "3"}, {"reach", "0.0025"}},
                   {{"rms_move", 0.0012, "m"}},
                   0.25,
                   {{"reach", "length", "0.001", "", "m", ""}}}};
  for (int i = 0; i < 3; ++i) {
    Phase phase{"phase <" + std::to_string(i) + ">", make_sphere(1 - 0.1 * i, 2), {}};
    const std::size_t count = phase.mesh.positions.size();
    phase.mesh.attributes.sigma.assign(count, 0.001f);
    phase.mesh.attributes.origin.assign(count, Origin::invented);
    phase.mesh.attributes.observations.assign(count, 5);
    phase.deviation.assign(count, 0.1f * static_cast<float>(i));
    record.phases.push_back(std::move(phase));
    record.comparisons.push_back({record.phases.back().name, {{"rms_distance", 0.1 * i, "m"}}});
  }
  record.notes = {"comment: </style><img src=http:x onerror=alert(2)>", "broken \xc3\x28 text"};
  record.versions = {{"burnish", "0.1.0"}};
  return record;
}

const ReportOptions kSmall{.picture_width = 64, .picture_height = 48};

std::string page_of(const Record& record, const ReportOptions& options = kSmall,
                    const Context& context = {}) {
  const auto plates = paint_plates(record, options, context);
  if (!plates) return "paint_plates: " + plates.error().text();
  const auto page = html_report(record, *plates, context);
  return page ? *page : "html_report: " + page.error().text();
}

std::size_t count_of(std::string_view text, std::string_view part) {
  std::size_t count = 0;
  for (std::size_t at = text.find(part); at != text.npos; at = text.find(part, at + 1)) ++count;
  return count;
}

TEST(Report, IsWellFormed) {
  EXPECT_EQ(test::malformed(page_of(full_record())), "");
}

TEST(Report, NeedsNothingFromOutside) {
  const std::string page = page_of(full_record());
  EXPECT_EQ(count_of(page, "http://"), 0u);
  EXPECT_EQ(count_of(page, "https://"), 0u);
  EXPECT_EQ(count_of(page, "href="), 0u);
  EXPECT_EQ(count_of(page, "url("), 0u);
  EXPECT_EQ(count_of(page, "@import"), 0u);
  EXPECT_EQ(count_of(page, " src=\""), count_of(page, " src=\"data:image/png;base64,"));
  EXPECT_EQ(count_of(page, " src=\""), 3u * 6u) << "three phases from six views";
}

TEST(Report, ShowsNamesAndCommentsAsText) {
  const std::string page = page_of(full_record());
  EXPECT_EQ(count_of(page, "<script>"), 1u) << "its own";
  EXPECT_EQ(count_of(page, "</style>"), 1u) << "its own";
  EXPECT_EQ(count_of(page, "<b>sphere"), 0u);
  EXPECT_EQ(count_of(page, "&lt;script&gt;alert(1)&lt;/script&gt;.ply"), 1u);
  EXPECT_EQ(count_of(page, "broken \uFFFD( text"), 1u);
  EXPECT_GE(count_of(page, "A &lt;b&gt;sphere&lt;/b&gt; &amp; &quot;more&quot;"), 2u);
}

TEST(Report, SaysWhatIsCertifiedAndWhatIsNot) {
  Record record = full_record();
  EXPECT_EQ(count_of(page_of(record), "Noise bound"), 0u);
  record.certificate = NoiseCertificate{.c = 1.75, .vertices = 420, .at_bound = 37};
  record.certificate->largest_ratio = 1.74321;
  const std::string page = page_of(record);
  EXPECT_EQ(test::malformed(page), "");
  EXPECT_EQ(count_of(page, "Noise bound"), 1u);
  EXPECT_EQ(count_of(page, "farther than c = 1.75 standard deviations"), 1u);
  EXPECT_EQ(count_of(page, "largest ratio 1.74321; 37 of 420 vertices"), 1u);
  EXPECT_EQ(count_of(page, kNotCovered), 1u);
}

TEST(Report, WritesParametersAndFactsWithUnits) {
  const std::string page = page_of(full_record());
  EXPECT_EQ(count_of(page, "2.5\u202fmm"), 1u) << "a setting whose schema says metres";
  EXPECT_EQ(count_of(page, "1.2\u202fmm"), 1u) << "a fact in metres";
}

TEST(Report, SaysHowManyTrianglesWereInventedAndShowsTheirColour) {
  Record record;
  record.phases = {{"original", make_box({1, 1, 1}, 1), {}}};
  EXPECT_EQ(count_of(page_of(record), "nvented"), 0u);
  std::vector<Origin>& origin = record.phases[0].mesh.triangle_attributes.origin;
  origin.assign(12, Origin::seen);
  origin[3] = origin[7] = origin[8] = Origin::invented;
  const std::string page = page_of(record);
  EXPECT_EQ(count_of(page, "12 vertices; 3 invented") + count_of(page, "8 vertices; 3 invented"),
            1u);
  EXPECT_EQ(count_of(page, "invented, where nothing was seen"), 1u);
  EXPECT_EQ(count_of(page, "Invented triangles"), 1u);
  EXPECT_EQ(count_of(page, "Invented area, m²"), 1u);
  EXPECT_EQ(count_of(page, ">1.50<"), 1u) << "three halves of a side";
}

TEST(Report, NamesEveryPictureAndTableHeader) {
  const std::string page = page_of(full_record());
  EXPECT_EQ(count_of(page, "<img "), count_of(page, " alt=\"phase"));
  EXPECT_EQ(count_of(page, "<table"), count_of(page, "<caption>"));
  EXPECT_EQ(count_of(page, "<th "), count_of(page, "<th scope=\""));
  EXPECT_EQ(count_of(page, "<th>"), 0u);
}

TEST(Report, IsTheSameForAnyNumberOfThreads) {
  const Record record = full_record();
  Context context;
  context.threads = 1;
  const std::string first = page_of(record, kSmall, context);
  for (const int threads : {2, 3, 8}) {
    context.threads = threads;
    EXPECT_EQ(page_of(record, kSmall, context), first) << threads << " threads";
  }
}

TEST(Report, OfAnEmptyRecordOrEmptyMeshesIsWellFormed) {
  EXPECT_EQ(test::malformed(page_of({})), "");
  Record record;
  record.phases = {{"original", {}, {}}, {"phase 1", {}, {}}};
  const std::string page = page_of(record);
  EXPECT_EQ(test::malformed(page), "");
  EXPECT_EQ(count_of(page, "nan"), 0u);
}

TEST(Report, PicturesFirstAndLastOfManyPhases) {
  Record record;
  for (int i = 0; i < 9; ++i) {
    record.phases.push_back({"phase " + std::to_string(i), make_sphere(1, 1), {}});
  }
  const auto plates =
      paint_plates(record, {.picture_width = 8, .picture_height = 6, .pictured_phases = 3});
  ASSERT_TRUE(plates);
  EXPECT_EQ(plates->phases, (std::vector<std::size_t>{0, 4, 8}));
}

TEST(Report, SeesASceneFromItsCamera) {
  Record record;
  record.phases = {{"room", make_box({4, 3, 2}, 4), {}}};
  Viewpoint viewpoint;
  viewpoint.camera = {640, 480, 525, 525, 319.5, 239.5};
  record.viewpoint = viewpoint;
  const auto within = paint_plates(record, kSmall);
  record.viewpoint->T_world_camera.translation = {0, 0, -5};
  const auto outside = paint_plates(record, kSmall);
  ASSERT_TRUE(within && outside);
  EXPECT_EQ(within->plates.front().name, "camera");
  EXPECT_EQ(outside->plates.front().name, "front");
}

TEST(Report, NamesThePhaseThatIsNoMesh) {
  Record record = full_record();
  record.phases[1].mesh.triangles.push_back({0, 1, 99999});
  const auto plates = paint_plates(record, kSmall);
  ASSERT_FALSE(plates);
  EXPECT_EQ(plates.error().code, ErrorCode::bad_geometry);
  EXPECT_EQ(plates.error().where, "phase <1>");
}

TEST(WriteReport, WritesWhatHtmlReportSays) {
  const test::TemporaryFolder folder;
  const Record record = full_record();
  const auto written = write_report(folder / "report.html", record, kSmall);
  ASSERT_TRUE(written) << written.error().text();
  std::ifstream file(folder / "report.html", std::ios::binary);
  std::stringstream bytes;
  bytes << file.rdbuf();
  EXPECT_EQ(bytes.str(), page_of(record));
}

TEST(WriteReport, LeavesNoFileWhenCancelled) {
  // Stops at the first report of progress beyond a share of the work.
  struct Stop : ProgressSink {
    std::stop_source source;
    double at = 0;
    void on_progress(double fraction) override {
      if (fraction >= at) source.request_stop();
    }
  };
  for (const double at : {0.0, 0.3, 0.85, 0.95, 0.985}) {
    const test::TemporaryFolder folder;
    Stop stop;
    stop.at = at;
    Context context;
    context.sink = &stop;
    context.stop = stop.source.get_token();
    const auto written = write_report(folder / "report.html", full_record(), kSmall, context);
    ASSERT_FALSE(written) << at;
    EXPECT_EQ(written.error().code, ErrorCode::cancelled);
    EXPECT_TRUE(fs::is_empty(folder.path()));
  }
}

TEST(WriteReport, ReportsProgressThatRisesToOne) {
  struct Rising : ProgressSink {
    double last = 0;
    bool rising = true;
    void on_progress(double fraction) override {
      rising = rising && fraction >= last;
      last = fraction;
    }
  };
  const test::TemporaryFolder folder;
  Rising sink;
  Context context;
  context.sink = &sink;
  ASSERT_TRUE(write_report(folder / "report.html", full_record(), kSmall, context));
  EXPECT_TRUE(sink.rising);
  EXPECT_EQ(sink.last, 1);
}

TEST(WritePictures, NamesFilesByViewAndPhase) {
  const test::TemporaryFolder folder;
  const Record record = full_record();
  const auto plates = paint_plates(record, kSmall);
  ASSERT_TRUE(plates);
  const auto paths = write_pictures(folder / "sphere", record, *plates);
  ASSERT_TRUE(paths) << paths.error().text();
  ASSERT_EQ(paths->size(), 1u + 3u * 6u);
  EXPECT_EQ(paths->front().filename(), "sphere-overview.png");
  EXPECT_EQ((*paths)[1].filename(), "sphere-front-phase-0.png");
  for (const fs::path& path : *paths) EXPECT_GT(fs::file_size(path), 0u) << path;
}

TEST(ContactSheet, HoldsEveryPictureInItsPlace) {
  const Record record = full_record();
  const auto plates = paint_plates(record, kSmall);
  ASSERT_TRUE(plates);
  const Image sheet = contact_sheet(record, *plates);
  const Image& last = plates->plates.back().pictures.back();
  for (std::uint32_t y = 0; y < last.height; ++y) {
    for (std::uint32_t x = 0; x < last.width; ++x) {
      ASSERT_EQ(sheet.at(sheet.width - last.width + x, sheet.height - last.height + y),
                last.at(x, y));
    }
  }
}

}  // namespace
}  // namespace burnish
