#pragma once

#include <memory>
#include <span>

#include "burnish/base/context.h"
#include "burnish/base/result.h"
#include "burnish/core/triangle_mesh.h"
#include "burnish/report/image.h"
#include "burnish/report/view.h"

namespace burnish {

/// How a surface is painted.
struct PictureOptions {
  std::uint32_t width = 640, height = 480;  ///< pixels, 1 to 16384
  bool smooth_normals = false;              ///< false: one normal a triangle, noise is seen
  bool edges = false;                       ///< draw the triangles' edges
  bool vertex_colors = false;               ///< where the mesh has them, instead of `surface`
  bool origin = true;                       ///< tint vertices and triangles not seen
  Color surface{228, 223, 214, 255};
  Color back{178, 74, 118, 255};  ///< triangles seen from their inner side
  Color interpolated{150, 186, 205, 255};
  Color invented{226, 160, 52, 255};
  Color edge{38, 46, 58, 255};
  Color background{246, 245, 242, 255};
  /// One number per vertex to paint instead of `surface`, by color_of from `low` to `high`; where
  /// it is not finite the surface keeps its colour. Empty: none.
  std::span<const float> scalars{};
  double low = 0, high = 1;
};

/// A mesh made ready to be painted from several views. Keeps a reference to the mesh.
class Painter {
 public:
  /// O(#T log #T). Errors: bad_geometry, cancelled.
  static Result<Painter> create(const TriangleMesh& mesh, const Context& context = {});
  Painter(Painter&&) noexcept;
  Painter& operator=(Painter&&) noexcept;
  ~Painter();

  /// Casts four rays a pixel, at fixed places in it. The same bytes for any number of threads.
  /// Errors: invalid_argument (sizes, scalars not #V long, a view without an opening), cancelled.
  Result<Image> paint(const View& view, const PictureOptions& options = {},
                      const Context& context = {}) const;

 private:
  struct Scene;
  explicit Painter(std::unique_ptr<Scene> scene);
  std::unique_ptr<Scene> scene_;
};

/// One picture: Painter::create and paint in one.
Result<Image> render(const TriangleMesh& mesh, const View& view, const PictureOptions& options = {},
                     const Context& context = {});

}  // namespace burnish
