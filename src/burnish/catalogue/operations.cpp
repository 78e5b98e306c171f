#include "burnish/catalogue/operations.h"

#include "burnish/adaptation/loop.h"
#include "burnish/adaptation/midpoint.h"
#include "burnish/adaptation/point_removal.h"
#include "burnish/adaptation/quadric_collapse.h"
#include "burnish/adaptation/split.h"
#include "burnish/adaptation/sqrt3.h"
#include "burnish/points/merge_cells.h"
#include "burnish/points/remove_flying_pixels.h"
#include "burnish/points/remove_outliers.h"
#include "burnish/repair/manifold_cuts.h"
#include "burnish/repair/small_components.h"
#include "burnish/smoothing/automatic.h"
#include "burnish/smoothing/bilateral.h"
#include "burnish/smoothing/bilateral_depth.h"
#include "burnish/smoothing/bilateral_normal.h"
#include "burnish/smoothing/equalize.h"
#include "burnish/smoothing/gaussian.h"
#include "burnish/smoothing/guided_normal.h"
#include "burnish/smoothing/humphrey.h"
#include "burnish/smoothing/implicit.h"
#include "burnish/smoothing/l0.h"
#include "burnish/smoothing/laplacian.h"
#include "burnish/smoothing/nearest_farthest.h"
#include "burnish/smoothing/one_ring_mean.h"
#include "burnish/smoothing/taubin.h"
#include "burnish/smoothing/temporal_mean.h"
#include "burnish/smoothing/windowed_sinc.h"
#include "burnish/triangulation/delaunay.h"
#include "burnish/triangulation/fan_cloud_mesh.h"
#include "burnish/triangulation/fan_thinning.h"
#include "burnish/triangulation/global.h"
#include "burnish/triangulation/organized.h"

// The list of everything that burnish can do. A new method is one line here.
namespace burnish {

std::span<const AverageOperation> average_operations() {
  static const std::vector<AverageOperation> list{
      creation_operation("temporal_mean", temporal_mean, &TemporalMean::frame,
                         "The mean of frames from one place, without what moves through them.", ""),
  };
  return list;
}

std::span<const FilterOperation> filter_operations() {
  static const std::vector<FilterOperation> list{
      edit_operation("bilateral_depth", smooth_bilateral_depth,
                     "Depths are averaged with near ones that the noise lets be of one surface.",
                     "tomasi_manduchi_1998"),
  };
  return list;
}

std::span<const CleanOperation> clean_operations() {
  static const std::vector<CleanOperation> list{
      edit_operation("flying_pixels", remove_flying_pixels,
                     "Pixels between two surfaces, seen at a grazing angle, or in specks go.", ""),
      edit_operation("outliers", remove_outliers,
                     "Points that lie farther from the others than these from each other go.", ""),
  };
  return list;
}

std::span<const MergeOperation> merge_operations() {
  static const std::vector<MergeOperation> list{
      creation_operation("cells", merge_cells, &Merging::cloud,
                         "Points of one surface patch are averaged, weighted by their precision.",
                         ""),
  };
  return list;
}

std::span<const ThinOperation> thin_operations() {
  static const std::vector<ThinOperation> list{
      edit_operation("fan_cloud", thin_by_fans,
                     "Points go in the order of the information they carry, as their fans tell.",
                     "linsen_prautzsch_2003"),
  };
  return list;
}

std::span<const TriangulateOperation> triangulate_operations() {
  static const std::vector<TriangulateOperation> list{
      creation_operation("fan_cloud", triangulate_fan_cloud, &Triangulation::mesh,
                         "A fan of triangles around every point, each on its own.",
                         "linsen_prautzsch_2003"),
      creation_operation("global", triangulate_global, &Triangulation::mesh,
                         "One orientable manifold surface from what the local fans agree on.",
                         "linsen_prautzsch_2001"),
      creation_operation("delaunay", triangulate_delaunay, &Triangulation::mesh,
                         "The Delaunay triangulation of a projection: surfaces of one sheet.",
                         "guibas_stolfi_1985"),
      creation_operation("organized", triangulate_organized, &Triangulation::mesh,
                         "The image grid of one frame, cut at depth jumps beyond the noise.", ""),
  };
  return list;
}

std::span<const RepairOperation> repair_operations() {
  static const std::vector<RepairOperation> list{
      edit_operation("small_components", remove_small_components,
                     "Components too small to be anything but specks of noise go.", ""),
      edit_operation("manifold", make_manifold,
                     "Duplicate triangles go; the surface is cut where it is no manifold.",
                     "gueziec_2001"),
  };
  return list;
}

std::span<const SmoothOperation> smooth_operations() {
  static const std::vector<SmoothOperation> list{
      edit_operation("auto", smooth_auto,
                     "Removes the noise that is there: a small network chooses among normals that "
                     "classical filters give.",
                     "wang_liu_tong_2016"),
      edit_operation(
          "nearest_farthest", smooth_nearest_farthest,
          "Mean of the one-ring in which the nearest and the farthest neighbour count twice.",
          "ozbay_cinar"),
      edit_operation("one_ring_mean", smooth_one_ring_mean,
                     "Each vertex moves to the mean of its one-ring and itself.", "ozbay_cinar"),
      edit_operation(
          "gaussian", smooth_gaussian,
          "Mean of the one-ring and the vertex itself, weighted by a Gaussian of the distance.",
          "ozbay_cinar"),
      edit_operation("bilateral", smooth_bilateral,
                     "Each vertex moves along its normal to near vertices of about its height.",
                     "fleishman_2003"),
      edit_operation("bilateral_normal", smooth_bilateral_normal,
                     "Face normals are averaged with like ones around them, vertices follow them.",
                     "zheng_2011"),
      edit_operation("guided_normal", smooth_guided_normal,
                     "Face normals are filtered along the patches that are most of one piece.",
                     "zhang_2015"),
      edit_operation("laplacian", smooth_laplacian,
                     "Part of the way to the mean of the one-ring, by equal or cotangent weights.",
                     "desbrun_1999"),
      edit_operation("taubin", smooth_taubin,
                     "A step to the mean of the one-ring and one back: low-pass, no shrinkage.",
                     "taubin_1995"),
      edit_operation("windowed_sinc", smooth_windowed_sinc,
                     "A low-pass filter with a sharp cut-off; no shrinkage.",
                     "taubin_zhang_golub_1996"),
      edit_operation("humphrey", smooth_humphrey,
                     "Mean of the one-ring, then pushed back by what the one-ring moved (HC).",
                     "vollmer_1999"),
      edit_operation("implicit", smooth_implicit,
                     "Curvature flow in steps of any length, by solving a system of equations.",
                     "desbrun_1999"),
      edit_operation("l0", smooth_l0,
                     "As few bent edges as possible: flattens noisy facets, keeps their edges.",
                     "he_schaefer_2013"),
      edit_operation("equalize", smooth_equalize,
                     "Evens the distances to neighbours within the surface; smooths nothing.", ""),
  };
  return list;
}

std::span<const SimplifyOperation> simplify_operations() {
  static const std::vector<SimplifyOperation> list{
      edit_operation("quadric", simplify_quadric,
                     "Edges collapse to the point nearest to the planes that meet there.",
                     "garland_heckbert_1997"),
      edit_operation("point_removal", simplify_point_removal,
                     "Vertices are removed, none is moved: what is left was measured.",
                     "garland_heckbert_1997"),
  };
  return list;
}

std::span<const RefineOperation> refine_operations() {
  static const std::vector<RefineOperation> list{
      edit_operation("loop", refine_loop,
                     "Every triangle becomes four, and the surface smoother: a box-spline's.",
                     "loop_1987"),
      edit_operation(
          "sqrt3", refine_sqrt3,
          "Every triangle becomes three, old edges are flipped, the surface is smoothed.",
          "kobbelt_2000"),
      edit_operation("midpoint", refine_midpoint,
                     "Every triangle becomes four by the middles of its edges; nothing moves.", ""),
      edit_operation("split", refine_split,
                     "Edges that are too long, or the surface too bent along them, are split.",
                     "rivara_1997"),
  };
  return list;
}

}  // namespace burnish
