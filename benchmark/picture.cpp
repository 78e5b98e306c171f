#include <cstdio>
#include <cstdlib>
#include <sstream>
#include <string>

#include "burnish/io/geometry_file.h"
#include "burnish/io/png.h"
#include "burnish/measure/truth.h"
#include "burnish/report/picture.h"

// burnish_benchmark_picture MESH OUT.png [width=W] [height=H] [forward=x,y,z] [up=x,y,z]
//                           [at=x,y,z size=S] [edges] [truth=MESH limit=D]
// The whole mesh looked at along `forward`, or the ball of radius `size` around `at`. With a truth,
// vertices are coloured by their distance from it, from 0 to `limit`.
namespace {

using namespace burnish;

[[noreturn]] void fail(const Error& error) {
  std::fprintf(stderr, "%s %s\n", error.where.c_str(), error.message.c_str());
  std::exit(1);
}

struct Options {
  PictureOptions picture;
  Vec3d forward{0.4, 1, -0.5}, up{0, 0, 1}, at{};
  double size = 0, limit = 0;
  std::string truth;
};

Vec3d vector_of(const std::string& text) {
  std::istringstream stream(text);
  Vec3d v;
  char comma;
  stream >> v.x >> comma >> v.y >> comma >> v.z;
  return v;
}

Options read_options(int argc, char** argv) {
  Options options;
  for (int i = 3; i < argc; ++i) {
    const std::string word = argv[i], key = word.substr(0, word.find('='));
    const std::string value = key == word ? "" : word.substr(key.size() + 1);
    if (key == "width") options.picture.width = static_cast<std::uint32_t>(std::stoul(value));
    if (key == "height") options.picture.height = static_cast<std::uint32_t>(std::stoul(value));
    if (key == "forward") options.forward = vector_of(value);
    if (key == "up") options.up = vector_of(value);
    if (key == "at") options.at = vector_of(value);
    if (key == "size") options.size = std::stod(value);
    if (key == "edges") options.picture.edges = true;
    if (key == "truth") options.truth = value;
    if (key == "limit") options.limit = std::stod(value);
  }
  return options;
}

View view_of(const TriangleMesh& mesh, const Options& options) {
  const double aspect = static_cast<double>(options.picture.width) / options.picture.height;
  View view = framing_view("", mesh, options.forward, options.up, aspect);
  if (options.size > 0) {
    const double away = options.size / view.half_height;
    view.T_world_camera =
        look_at(options.at - away * normalized(options.forward), options.at, options.up);
  }
  return view;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc < 3) return 2;
  Options options = read_options(argc, argv);
  const Result<TriangleMesh> mesh = read_mesh(argv[1]);
  if (!mesh) fail(mesh.error());
  std::vector<float> deviation;
  if (!options.truth.empty()) {
    const Result<TriangleMesh> truth = read_mesh(options.truth);
    if (!truth) fail(truth.error());
    auto comparison = compare_to_truth(*mesh, *truth, {.samples = 1});
    if (!comparison) fail(comparison.error());
    deviation = std::move(comparison->deviation);
    options.picture.scalars = deviation;
    options.picture.high = options.limit;
  }
  const Result<Image> image = render(*mesh, view_of(*mesh, options), options.picture);
  if (!image) fail(image.error());
  if (auto done = write_png(argv[2], image->width, image->height, image->pixels); !done) {
    fail(done.error());
  }
}
