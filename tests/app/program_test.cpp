// The program as a user meets it: exit statuses, messages, help, Ctrl-C, and the main job.
#include "app/program.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "burnish/catalogue/operations.h"
#include "burnish/core/topology.h"
#include "burnish/io/geometry_file.h"
#include "burnish/shapes/shapes.h"
#include "support/random_mesh.h"
#include "support/test_data.h"

namespace burnish {
namespace {

namespace fs = std::filesystem;
using test::burnish;
using test::bytes_of;
using test::Outcome;
using test::TemporaryFolder;

std::vector<std::string> names_in(const fs::path& folder) {
  std::vector<std::string> names;
  for (const auto& entry : fs::directory_iterator(folder)) names.push_back(entry.path().filename());
  std::sort(names.begin(), names.end());
  return names;
}

void write_text(const fs::path& path, const std::string& text) {
  std::ofstream(path) << text;
}

TEST(Program, SaysItsVersion) {
  const Outcome outcome = burnish({"--version"});
  EXPECT_EQ(outcome.status, 0);
  EXPECT_TRUE(outcome.out.starts_with("burnish ")) << outcome.out;
}

TEST(Program, EveryVerbHasHelpWithAnExample) {
  for (const char* verb : {"reconstruct", "triangulate", "smooth", "simplify", "refine", "adapt",
                           "progressive", "extract", "verify", "convert", "measure", "simulate",
                           "import", "register", "repair", "reproduce", "list"}) {
    const Outcome outcome = burnish({verb, "--help"});
    EXPECT_EQ(outcome.status, 0) << verb;
    EXPECT_NE(outcome.out.find(std::string("burnish ") + verb), std::string::npos) << outcome.out;
    EXPECT_NE(outcome.out.find("Example"), std::string::npos) << verb;
  }
}

TEST(Program, SimplifyRefusesWhatWouldBindNothing) {
  const test::TemporaryFolder folder;
  ASSERT_TRUE(write_mesh(folder / "box.ply", make_box()));
  for (const std::vector<std::string>& options :
       {std::vector<std::string>{"--max_error", "0"},
        {"--max_error", "noise:c=0"},
        {"-m", "quadric", "-m", "point_removal", "--max_error", "1mm"}}) {
    std::vector<std::string> words{"simplify", folder / "box.ply", "-o", folder / "small.ply"};
    words.insert(words.end(), options.begin(), options.end());
    EXPECT_EQ(burnish(words).status, 2) << options[1];
    EXPECT_FALSE(std::filesystem::exists(folder / "small.ply"));
  }
}

TEST(Program, ListNamesEveryMethodOfTheCatalogueWithItsParameters) {
  const Outcome outcome = burnish({"list"});
  ASSERT_EQ(outcome.status, 0);
  for (const auto family : families()) {
    for (const OperationInfo& info : operations_of(family)) {
      EXPECT_NE(outcome.out.find(info.name), std::string::npos) << info.name;
      for (const FieldInfo& field : info.fields) {
        EXPECT_NE(outcome.out.find(field.key + "=" + field.default_value), std::string::npos)
            << field.key;
      }
    }
  }
  EXPECT_EQ(burnish({"list", "nothing_such"}).status, 2);
}

TEST(Program, RefusesWhatItDoesNotKnow) {
  const TemporaryFolder folder;
  ASSERT_TRUE(write_mesh(folder / "box.ply", make_box()));
  const std::string in = folder / "box.ply", out = folder / "out.ply";
  EXPECT_EQ(burnish({}).status, 2);
  EXPECT_EQ(burnish({"polish"}).status, 2);
  EXPECT_EQ(burnish({"smooth", in}).status, 2);
  for (const char* method : {"polish", "one_ring_mean:passes=2", "one_ring_mean:iterations=-1",
                             "one_ring_mean:iterations", "one_ring_mean:"}) {
    const Outcome outcome = burnish({"smooth", in, "-o", out, "--method", method});
    EXPECT_EQ(outcome.status, 2) << method;
    EXPECT_TRUE(outcome.err.starts_with("burnish: ")) << outcome.err;
    EXPECT_FALSE(fs::exists(out));
  }
}

TEST(Program, SmoothsByAutoWhereNoMethodIsNamed) {
  const TemporaryFolder folder;
  ASSERT_TRUE(write_mesh(folder / "noisy.ply", test::with_noise(make_sphere(1, 3), 0.02, 1)));
  const std::string in = folder / "noisy.ply", unnamed = folder / "a.ply", named = folder / "b.ply";
  ASSERT_EQ(burnish({"smooth", in, "-o", unnamed}).status, 0);
  ASSERT_EQ(burnish({"smooth", in, "-o", named, "--method", "auto"}).status, 0);
  const auto before = read_mesh(in), by_default = read_mesh(unnamed), by_name = read_mesh(named);
  ASSERT_TRUE(before && by_default && by_name);
  EXPECT_EQ(by_default->positions, by_name->positions);
  EXPECT_NE(by_default->positions, before->positions);
}

TEST(Program, NamesTheFileThatIsMissingOrDamaged) {
  const TemporaryFolder folder;
  const Outcome missing = burnish({"convert", folder / "none.ply", folder / "out.ply"});
  EXPECT_EQ(missing.status, 3);
  EXPECT_NE(missing.err.find("none.ply"), std::string::npos);

  write_text(folder / "bad.ply",
             "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\n"
             "property float z\nend_header\n0 0 0\n0.125 0.25\n0 1 0\n");
  const Outcome damaged = burnish({"convert", folder / "bad.ply", folder / "out.ply"});
  EXPECT_EQ(damaged.status, 4);
  EXPECT_NE(damaged.err.find("bad.ply"), std::string::npos) << damaged.err;
  EXPECT_NE(damaged.err.find("line 9"), std::string::npos) << damaged.err;
  EXPECT_FALSE(fs::exists(folder / "out.ply"));
}

TEST(Program, RefusesAnOutputThatCannotBeBeforeItWorks) {
  const TemporaryFolder folder;
  ASSERT_TRUE(write_mesh(folder / "box.ply", make_box()));
  const std::string in = folder / "box.ply";
  for (const std::string out : {folder / "out.xyz2", folder / "none" / "out.ply"}) {
    const Outcome outcome = burnish({"smooth", in, "-o", out, "--method", "one_ring_mean"});
    EXPECT_NE(outcome.status, 0);
    EXPECT_NE(outcome.err.find(fs::path(out).parent_path().filename().string()), std::string::npos)
        << outcome.err;
  }
}

TEST(Program, NamesTheVerbThatItDoesNotKnow) {
  const Outcome outcome = burnish({"smoth"});
  EXPECT_EQ(outcome.status, 2);
  EXPECT_NE(outcome.err.find("'smoth'"), std::string::npos) << outcome.err;
}

TEST(Program, NoticesAFullStandardOutput) {
  const Outcome outcome = test::run_program({"/bin/sh", "-c", BURNISH_PROGRAM " list > /dev/full"});
  EXPECT_EQ(outcome.status, 7) << outcome.err;
}

TEST(Program, RefusesAnEmptyResult) {
  const TemporaryFolder folder;
  ASSERT_TRUE(write_mesh(folder / "sphere.ply", make_sphere()));
  const std::string in = folder / "sphere.ply", out = folder / "out.ply";
  EXPECT_EQ(burnish({"reconstruct", in, "-o", out, "--crop", "box:5,5,5,6,6,6"}).status, 6);
  write_text(folder / "two.xyz", "0 0 0\n1 0 0\n");
  EXPECT_EQ(burnish({"triangulate", folder / "two.xyz", "-o", out}).status, 6);
  EXPECT_FALSE(fs::exists(out));
}

TEST(Program, RefusesOptionsThatMeanNothing) {
  const TemporaryFolder folder;
  ASSERT_TRUE(write_mesh(folder / "sphere.ply", make_sphere()));
  const std::string in = folder / "sphere.ply", out = folder / "out.ply";
  EXPECT_EQ(burnish({"reconstruct", in, "-o", out, "--merge", "none"}).status, 2);
  EXPECT_EQ(burnish({"reconstruct", in, "-o", out, "--triangulate", "none"}).status, 2);
  EXPECT_EQ(burnish({"reconstruct", in, "-o", out, "--camera", "525,525,320,240"}).status, 2);
  EXPECT_EQ(burnish({"reconstruct", in, "-o", out, "--depth_scale", "1mm"}).status, 2);
  EXPECT_EQ(burnish({"reconstruct", in, "-o", out, "--depth_scale", "0"}).status, 2);
  EXPECT_FALSE(fs::exists(out));
}

TEST(Program, AViewpointThatIsNoPlaceMakesAFileBad) {
  const TemporaryFolder folder;
  write_text(folder / "nan.pcd",
             "VERSION .7\nFIELDS x y z\nSIZE 4 4 4\nTYPE F F F\nCOUNT 1 1 1\nWIDTH 2\n"
             "HEIGHT 2\nVIEWPOINT nan 0 0 1 0 0 0\nPOINTS 4\nDATA ascii\n"
             "0 0 1\n1 0 1\n0 1 1\n1 1 1\n");
  const Outcome outcome = burnish({"convert", folder / "nan.pcd", folder / "out.ply"});
  EXPECT_EQ(outcome.status, 4);
  EXPECT_NE(outcome.err.find("VIEWPOINT"), std::string::npos) << outcome.err;
}

TEST(Program, SaysWhatAReaderLeftOut) {
  const TemporaryFolder folder;
  write_text(folder / "cloud.xyz", "0 0 0\n1 0 0\nnan nan nan\n0 1 0\n1 1 0\n");
  const Outcome outcome = burnish({"triangulate", folder / "cloud.xyz", "-o", folder / "mesh.ply"});
  EXPECT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_NE(outcome.out.find("1 of 5 points are not finite and are left out"), std::string::npos)
      << outcome.out;
}

TEST(Program, ReproducesTable1OnShapesWithoutData) {
  const TemporaryFolder empty;
  const Outcome outcome = burnish({"reproduce", "table1", "--rounds", "1", "--data", empty.path()});
  EXPECT_EQ(outcome.status, 0) << outcome.err;
  for (const char* part :
       {"generated", "69451", "Global triangulation", "fan_cloud", "not confirmed"})
    EXPECT_NE(outcome.out.find(part), std::string::npos) << part << "\n" << outcome.out;
  EXPECT_NE(burnish({"reproduce", "figure6", "--rounds", "2"}).status, 0);
  EXPECT_NE(burnish({"reproduce", "table1", "--data", "/no/such/folder"}).status, 0);
}

TEST(Program, QuietPrintsNothing) {
  const TemporaryFolder folder;
  ASSERT_TRUE(write_mesh(folder / "box.ply", make_box()));
  const Outcome outcome = burnish(
      {"-q", "smooth", folder / "box.ply", "-o", folder / "out.ply", "-m", "one_ring_mean"});
  EXPECT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_EQ(outcome.out + outcome.err, "");
  EXPECT_TRUE(read_mesh(folder / "out.ply"));
}

/// A bumpy sphere that knows how far its vertices may be off.
TriangleMesh measured_sphere() {
  TriangleMesh mesh = test::with_noise(make_sphere(1, 3), 0.02, 1);
  for (const Vec3f& p : mesh.positions) {
    mesh.attributes.noise.push_back({Vec3f(normalized(Vec3d(p))), 0.01f, 0.004f});
  }
  return mesh;
}

TEST(Program, BindsASmoothingToTheNoiseAndVerifiesIt) {
  const TemporaryFolder folder;
  const std::string before = folder / "before.ply", bound = folder / "bound.ply",
                    free = folder / "free.ply";
  ASSERT_TRUE(write_mesh(before, measured_sphere()));
  const std::string method = "gaussian:iterations=5";
  const Outcome smoothed = burnish({"smooth", before, "-o", bound, "-m", method, "--bound",
                                    "noise:c=1.5", "--report", folder / "report.html"});
  ASSERT_EQ(smoothed.status, 0) << smoothed.err;
  for (const std::string& text :
       {smoothed.out, bytes_of(bound), bytes_of(folder / "report.html")}) {
    EXPECT_NE(text.find("farther than c = 1.5 standard deviations"), std::string::npos);
    EXPECT_NE(text.find("not covered: noise that neighbouring"), std::string::npos);
  }
  const Outcome held = burnish({"verify", before, bound, "--c", "1.5"});
  EXPECT_EQ(held.status, 0) << held.err;
  EXPECT_NE(held.out.find("largest ratio 1.4999"), std::string::npos) << held.out;
  const Outcome narrower = burnish({"verify", before, bound, "--c", "1.4"});
  EXPECT_EQ(narrower.status, 9);

  ASSERT_EQ(burnish({"smooth", before, "-o", free, "-m", method}).status, 0);
  const Outcome refuted = burnish({"verify", before, free});
  EXPECT_EQ(refuted.status, 9);
  EXPECT_EQ(refuted.out, "");
  for (const char* part : {"free.ply", "vertex ", "one deviation is 0.0", "ratio "})
    EXPECT_NE(refuted.err.find(part), std::string::npos) << refuted.err;
  const Outcome json = burnish({"verify", before, free, "--json"});
  EXPECT_EQ(json.status, 9);
  for (const char* part : {"\"holds\": false", "\"c\": 2.0", "\"worst_displacement_m\": 0."})
    EXPECT_NE(json.out.find(part), std::string::npos) << json.out;
}

TEST(Program, VerifyCatchesOneFloatStepInAFile) {
  const TemporaryFolder folder;
  TriangleMesh mesh = make_box();
  mesh.attributes.sigma.assign(mesh.positions.size(), 0.125f);
  const std::string before = folder / "before.ply", after = folder / "after.ply";
  ASSERT_TRUE(write_mesh(before, mesh));
  float& z = mesh.positions[3].z;
  z += 0.25f;  // two deviations to the bit
  ASSERT_TRUE(write_mesh(after, mesh));
  EXPECT_EQ(burnish({"verify", before, after}).status, 0);
  z = std::nextafter(z, 10.f);
  ASSERT_TRUE(write_mesh(after, mesh));
  const Outcome outcome = burnish({"verify", before, after});
  EXPECT_EQ(outcome.status, 9);
  EXPECT_NE(outcome.err.find("vertex 3"), std::string::npos) << outcome.err;
}

TEST(Program, RefusesToBindOrVerifyWhatItCannot) {
  const TemporaryFolder folder;
  const std::string plain = folder / "plain.ply", known = folder / "known.ply",
                    out = folder / "out.ply";
  ASSERT_TRUE(write_mesh(plain, make_box()));
  ASSERT_TRUE(write_mesh(known, measured_sphere()));
  const Outcome unknown =
      burnish({"smooth", plain, "-o", out, "-m", "one_ring_mean", "--bound", "noise"});
  EXPECT_EQ(unknown.status, 6);
  EXPECT_NE(unknown.err.find("give every vertex a 'sigma'"), std::string::npos) << unknown.err;
  for (const char* bound : {"sigma", "noise:c=-1", "noise:c"}) {
    EXPECT_EQ(burnish({"smooth", known, "-o", out, "-m", "one_ring_mean", "--bound", bound}).status,
              2)
        << bound;
  }
  EXPECT_FALSE(fs::exists(out));
  const Outcome others = burnish({"verify", known, plain});
  EXPECT_EQ(others.status, 6);
  EXPECT_NE(others.err.find("vertices before and "), std::string::npos) << others.err;
  EXPECT_EQ(burnish({"verify", plain, plain}).status, 6);
  EXPECT_EQ(burnish({"verify", known, known, "--c", "-1"}).status, 2);
}

TEST(Program, SmoothsInPhasesOneAfterAnother) {
  const TemporaryFolder folder;
  ASSERT_TRUE(write_mesh(folder / "box.ply", make_box({1, 1, 1}, 6)));
  const std::string in = folder / "box.ply";
  ASSERT_EQ(
      burnish({"smooth", in, "-o", folder / "two.ply", "-m", "one_ring_mean:iterations=2"}).status,
      0);
  ASSERT_EQ(burnish({"smooth", in, "-o", folder / "phases.ply", "-m", "one_ring_mean", "-m",
                     "one_ring_mean"})
                .status,
            0);
  const auto two = read_mesh(folder / "two.ply"), phases = read_mesh(folder / "phases.ply");
  ASSERT_TRUE(two && phases);
  for (std::size_t v = 0; v < two->positions.size(); ++v) {
    // Between phases positions are rounded to float once more.
    EXPECT_LT(norm(two->positions[v] - phases->positions[v]), 1.2e-7f) << v;
  }
}

TEST(Program, MeasuresWhatIsLeftOfNoiseWhereTheTrianglesAreThoseOfTheTruth) {
  const TemporaryFolder folder;
  const TriangleMesh truth = make_box({1, 1, 1}, 4);
  TriangleMesh half = truth;
  for (Vec3f& p : half.positions) p = 0.5f * p;
  ASSERT_TRUE(write_mesh(folder / "truth.ply", truth));
  ASSERT_TRUE(write_mesh(folder / "half.ply", half));
  ASSERT_TRUE(write_mesh(folder / "other.ply", make_box({1, 1, 1}, 5)));
  const auto measured = [&](const char* mesh) {
    return burnish({"measure", folder / mesh, "--truth", folder / "truth.ply", "--json"});
  };
  const Outcome same = measured("half.ply"), other = measured("other.ply");
  ASSERT_EQ(same.status, 0) << same.err;
  ASSERT_EQ(other.status, 0) << other.err;
  EXPECT_NE(same.out.find("\"volume_change\": -0.875"), std::string::npos) << same.out;
  EXPECT_NE(same.out.find("\"vertex_error_m\": 0.25"), std::string::npos) << same.out;
  EXPECT_NE(other.out.find("\"coverage\""), std::string::npos) << other.out;
  EXPECT_EQ(other.out.find("\"denoising\""), std::string::npos) << other.out;
}

TEST(Program, ThinsACloudAndPrintsTheWeights) {
  const TemporaryFolder folder;
  PointCloud cloud;
  cloud.positions = make_sphere(1, 3).positions;
  cloud.attributes.sigma.assign(cloud.positions.size(), 0.001f);
  ASSERT_TRUE(write_cloud(folder / "cloud.ply", cloud));
  const std::string in = folder / "cloud.ply", out = folder / "thin.pcd";
  const Outcome outcome = burnish({"simplify", in, "-o", out, "--target_points", "100", "--method",
                                   "fan_cloud:normal_weight=2"});
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_NE(outcome.out.find("distance_weight=1,normal_weight=2"), std::string::npos)
      << outcome.out;
  const auto thinned = read_cloud(out);
  ASSERT_TRUE(thinned);
  EXPECT_EQ(thinned->positions.size(), 100u);
  EXPECT_EQ(thinned->attributes.sigma.size(), 100u);
  const std::string part = folder / "part.ply";
  const Outcome adapted =
      burnish({"adapt", in, "-o", part, "--region", "sphere:0,0,1,50cm", "--outside_points", "60"});
  ASSERT_EQ(adapted.status, 0) << adapted.err;
  const auto focused = read_cloud(part);
  ASSERT_TRUE(focused);
  const auto near = [](const PointCloud& points) {
    return std::count_if(points.positions.begin(), points.positions.end(), [](const Vec3f& p) {
      return norm(p - Vec3f{0, 0, 1}) < 0.5f;
    });
  };
  EXPECT_EQ(near(*focused), near(cloud));
  EXPECT_EQ(focused->positions.size(), 60 + static_cast<std::size_t>(near(cloud)));
  EXPECT_EQ(
      burnish({"adapt", in, "-o", part, "--region", "sphere:0,0,1,1", "--outside_error", "1mm"})
          .status,
      2);
  EXPECT_EQ(burnish({"simplify", in, "-o", out, "--target_triangles", "100"}).status, 2);
  EXPECT_EQ(burnish({"simplify", in, "-o", out, "--method", "quadric"}).status, 2);
}

TEST(Program, SmoothsInARegionAlone) {
  const TemporaryFolder folder;
  TriangleMesh before = make_sphere(1, 3);
  for (const bool weighted : {false, true}) {
    if (weighted) {
      // What the file pins stays where it is inside the region, too.
      std::vector<float> weights(before.positions.size(), 1);
      for (std::size_t v = 0; v < weights.size(); ++v) weights[v] = before.positions[v].x > 0;
      before.attributes.channels = {{"smoothing_weight", weights}};
    }
    const std::string in = folder / "in.ply", out = folder / "out.ply";
    ASSERT_TRUE(write_mesh(in, before));
    const Outcome outcome =
        burnish({"smooth", in, "-o", out, "-m", "one_ring_mean", "--region", "sphere:0,0,1,50cm"});
    ASSERT_EQ(outcome.status, 0) << outcome.err;
    const auto after = read_mesh(out);
    ASSERT_TRUE(after);
    std::size_t moved = 0;
    for (std::size_t v = 0; v < before.positions.size(); ++v) {
      const Vec3f p = before.positions[v];
      const bool free = norm(p - Vec3f{0, 0, 1}) <= 0.5f && (!weighted || p.x > 0);
      EXPECT_EQ(after->positions[v] != p, free) << v;
      moved += free;
    }
    EXPECT_GT(moved, 10u);
    EXPECT_NE(outcome.out.find("free_vertices " + std::to_string(moved)), std::string::npos)
        << outcome.out;
    EXPECT_EQ(after->attributes.channels, before.attributes.channels);
  }
}

TEST(Program, AdaptsToWhatLiesNearAMesh) {
  const TemporaryFolder folder;
  const TriangleMesh before = make_sphere(1, 4);
  TriangleMesh part = make_sphere(0.3, 3);
  for (Vec3f& p : part.positions) p.z += 1;
  const std::string in = folder / "in.ply", near = folder / "near.ply", out = folder / "out.ply";
  ASSERT_TRUE(write_mesh(in, before));
  ASSERT_TRUE(write_mesh(near, part));
  const Outcome outcome = burnish({"adapt", in, "-o", out, "--region", "near:" + near + ",15cm",
                                   "--outside_triangles", "1000"});
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  const auto after = read_mesh(out);
  ASSERT_TRUE(after);
  EXPECT_LT(after->triangles.size(), before.triangles.size() / 2);
  // The distance from the finely cut ball is at most its sagitta off.
  const auto inside = [](const TriangleMesh& mesh) {
    return std::count_if(mesh.positions.begin(), mesh.positions.end(), [](const Vec3f& p) {
      return std::abs(norm(p - Vec3f{0, 0, 1}) - 0.3f) < 0.149f;
    });
  };
  EXPECT_GT(inside(*after), 100);
  EXPECT_EQ(inside(*after), inside(before));
  const Topology t = topology(*after);
  EXPECT_TRUE(t.closed() && t.oriented());
  EXPECT_EQ(t.euler_number, 2);

  for (const auto& wrong : {std::vector<std::string>{"--region", "sphere:9,9,9,1"},
                            {"--region", "cube:1"},
                            {"--region", "sphere:0,0,1,1", "--inside_error", "-1mm"},
                            {"--region", "sphere:0,0,1,1", "--outside_error", "1kg"},
                            {}}) {
    std::vector<std::string> words{"adapt", in, "-o", folder / "none.ply"};
    words.insert(words.end(), wrong.begin(), wrong.end());
    EXPECT_EQ(burnish(words).status, 2);
  }
  EXPECT_FALSE(fs::exists(folder / "none.ply"));
}

TEST(Program, ReconstructsWithARegionToSmooth) {
  const TemporaryFolder folder;
  ASSERT_TRUE(write_mesh(folder / "sphere.ply", make_sphere(1, 3)));
  const auto made = [&](std::vector<std::string> words) {
    const std::string out = folder / "out.ply";
    words.insert(words.begin(), {"reconstruct", folder / "sphere.ply", "-o", out});
    const Outcome outcome = burnish(words);
    EXPECT_EQ(outcome.status, 0) << outcome.err;
    return read_mesh(out);
  };
  const auto before = made({"--smooth", "none"});
  const auto after = made({"--smooth", "one_ring_mean", "--smooth_region", "box:-2,-2,0,2,2,2"});
  ASSERT_TRUE(before && after);
  ASSERT_EQ(before->positions.size(), after->positions.size());
  for (std::size_t v = 0; v < before->positions.size(); ++v) {
    EXPECT_EQ(after->positions[v] != before->positions[v], before->positions[v].z >= 0) << v;
  }
}

TEST(Program, RefusesARegionThatMeansNothing) {
  const TemporaryFolder folder;
  ASSERT_TRUE(write_mesh(folder / "sphere.ply", make_sphere()));
  const std::string in = folder / "sphere.ply", out = folder / "out.ply";
  for (const char* region : {"ball:0,0,0,1", "sphere:0,0,0,0", "sphere:9,9,9,1"}) {
    for (const std::vector<std::string>& words :
         {std::vector<std::string>{"smooth", in, "-o", out, "-m", "one_ring_mean", "--region"},
          std::vector<std::string>{"reconstruct", in, "-o", out, "--smooth_region"}}) {
      std::vector<std::string> all = words;
      all.emplace_back(region);
      const Outcome outcome = burnish(all);
      EXPECT_EQ(outcome.status, 2) << words[0] << " " << region;
      EXPECT_NE(outcome.err.find(region), std::string::npos) << outcome.err;
    }
  }
  EXPECT_EQ(burnish({"reconstruct", in, "-o", out, "--smooth", "none", "--smooth_region",
                     "sphere:0,0,0,1"})
                .status,
            2);
  EXPECT_FALSE(fs::exists(out));
}

TEST(Program, SeveralScansWithoutPosesAreRefusedWithWhatToGive) {
  const TemporaryFolder folder;
  ASSERT_TRUE(write_mesh(folder / "a.ply", make_sphere()));
  ASSERT_TRUE(write_mesh(folder / "b.ply", make_sphere()));
  const Outcome outcome =
      burnish({"reconstruct", folder / "a.ply", folder / "b.ply", "-o", folder / "out.ply"});
  EXPECT_EQ(outcome.status, 2) << outcome.err;
  EXPECT_NE(outcome.err.find("--poses"), std::string::npos) << outcome.err;
}

TEST(Program, RegistersATurntableAndReconstructsFromWhatItFound) {
  const TemporaryFolder folder;
  const std::string shots = folder / "shots", posed = folder / "posed", out = folder / "out.ply";
  ASSERT_EQ(burnish({"simulate", "teapot", "-o", shots, "--views", "12", "--rings", "1", "--size",
                     "0.3m", "--axis_offset", "2cm", "--step_jitter", "1deg"})
                .status,
            0);
  const Outcome found = burnish({"register", shots, "-o", posed, "--turntable"});
  ASSERT_EQ(found.status, 0) << found.err;
  EXPECT_NE(found.out.find("12 of 12"), std::string::npos) << found.out;
  EXPECT_TRUE(fs::exists(fs::path(posed) / "registration.json"));
  const Outcome made = burnish(
      {"reconstruct", shots, "--poses", posed + "/poses.txt", "-o", out, "--smooth", "none"});
  EXPECT_EQ(made.status, 0) << made.err;
  EXPECT_TRUE(read_mesh(out));
}

TEST(Program, RegisterRefusesWhatItCannotPlace) {
  const TemporaryFolder folder;
  const std::string shots = folder / "shots", posed = folder / "posed";
  ASSERT_EQ(burnish({"simulate", "sphere", "-o", shots, "--views", "6", "--rings", "1"}).status, 0);
  const Outcome found = burnish({"register", shots, "-o", posed, "--turntable"});
  EXPECT_EQ(found.status, 6) << found.out;
  EXPECT_FALSE(fs::exists(fs::path(posed) / "poses.txt"));
  EXPECT_EQ(burnish({"register", shots, "-o", posed, "--angle", "10deg"}).status, 2);
}

TEST(Program, RefinesAroundARegionAndSaysWhichVerticesAreNew) {
  const TemporaryFolder folder;
  ASSERT_TRUE(write_mesh(folder / "sphere.ply", make_sphere(1, 3)));
  const std::string in = folder / "sphere.ply", out = folder / "out.ply";
  const Outcome done = burnish({"refine", in, "-o", out, "-m", "sqrt3", "-m",
                                "split:target_edge_length=5cm", "--region", "sphere:0,0,1,20cm"});
  ASSERT_EQ(done.status, 0) << done.err;
  EXPECT_NE(done.out.find("refine sqrt3: new_vertices"), std::string::npos) << done.out;
  const auto before = read_mesh(in), after = read_mesh(out);
  ASSERT_TRUE(before && after);
  EXPECT_GT(after->positions.size(), before->positions.size());
  const Topology t = topology(*after);
  EXPECT_TRUE(t.closed() && t.oriented());
  EXPECT_EQ(t.euler_number, 2);
  ASSERT_EQ(after->attributes.origin.size(), after->positions.size());
  EXPECT_EQ(after->attributes.origin.front(), Origin::seen);
  EXPECT_EQ(after->attributes.origin.back(), Origin::interpolated);
  for (const char* bad : {"polish", "loop:iterations=17", "split:max_chord=-1"}) {
    EXPECT_EQ(burnish({"refine", in, "-o", folder / "no.ply", "-m", bad}).status, 2) << bad;
  }
  EXPECT_EQ(burnish({"refine", in, "-o", folder / "no.ply", "--region", "sphere:9,9,9,1"}).status,
            2);
  EXPECT_FALSE(fs::exists(folder / "no.ply"));
}

TEST(Program, InterruptStopsWithinASecondAndLeavesNoFile) {
  const TemporaryFolder folder;
  ASSERT_TRUE(write_mesh(folder / "grid.ply", make_grid(500, 500, 0.001)));
  const Outcome outcome = burnish({"smooth", folder / "grid.ply", "-o", folder / "out.ply", "-m",
                                   "one_ring_mean:iterations=100000"},
                                  1000);
  EXPECT_EQ(outcome.status, 130) << outcome.err;
  EXPECT_LT(outcome.seconds, 2.0);
  EXPECT_EQ(names_in(folder.path()), std::vector<std::string>{"grid.ply"});
}

TEST(Program, InterruptWhileComparingLargeMeshesStops) {
  const TemporaryFolder folder;
  ASSERT_TRUE(write_mesh(folder / "grid.ply", make_grid(900, 900, 0.001)));
  const std::string grid = folder / "grid.ply";
  const Outcome outcome = burnish({"measure", grid, "--truth", grid}, 1500);
  EXPECT_EQ(outcome.status, 130) << outcome.err;
  EXPECT_LT(outcome.seconds, 3.0);
}

TEST(Program, InterruptWhileSimulatingLeavesNoHalfFrame) {
  const TemporaryFolder folder;
  const Outcome outcome =
      burnish({"simulate", "teapot", "-o", folder / "scan", "--views", "500"}, 1500);
  EXPECT_EQ(outcome.status, 130) << outcome.err;
  EXPECT_LT(outcome.seconds, 2.5);
  for (const auto& entry : fs::recursive_directory_iterator(folder.path())) {
    EXPECT_EQ(entry.path().string().find(".tmp"), std::string::npos) << entry.path();
  }
}

/// The main job, small: the same bytes for any number of threads, and a sound mesh near the truth.
TEST(Program, ScansAndReconstructsASphereTheSameForAnyThreadCount) {
  const TemporaryFolder folder;
  const std::string scan = folder / "scan";
  const Outcome simulated =
      burnish({"simulate", "sphere", "-o", scan, "--views", "8", "--seed", "7"});
  ASSERT_EQ(simulated.status, 0) << simulated.err;
  std::string first;
  for (const char* threads : {"1", "2", "3", "8"}) {
    const std::string out = folder / (std::string("mesh") + threads + ".ply");
    const Outcome made = burnish({"reconstruct", scan, "-o", out, "--threads", threads});
    ASSERT_EQ(made.status, 0) << made.err;
    if (first.empty()) first = bytes_of(out);
    EXPECT_EQ(bytes_of(out), first) << threads << " threads";
  }
  const auto mesh = read_mesh(folder / "mesh1.ply");
  ASSERT_TRUE(mesh);
  const Topology t = topology(*mesh);
  EXPECT_EQ(t.non_manifold_edges, 0u);
  EXPECT_EQ(t.flipped_edges, 0u);
  EXPECT_EQ(t.non_manifold_vertices, 0u);
  EXPECT_GT(mesh->triangles.size(), 1000u);
  EXPECT_EQ(mesh->attributes.sigma.size(), mesh->positions.size());
}

}  // namespace
}  // namespace burnish
