#include "burnish/registration/projective.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>
#include <vector>

#include "burnish/base/parallel.h"
#include "burnish/registration/evidence.h"
#include "burnish/registration/normal_equations.h"
#include "burnish/registration/robust.h"

namespace burnish {
namespace {

constexpr std::size_t kRowsAtOnce = 8;
constexpr std::size_t kBlock = 16;  // pixels a side, in which evidence is looked at together
constexpr std::size_t kEvidenceStep = 4;
constexpr std::size_t kFewest = 300;  // matches that a level must have
/// How far a surface may curve within the half pixel by which counterparts miss each other, in
/// pixels: what remains of a residual where both sensors are exact.
constexpr double kCurvature = 0.05;

bool has_normal(const SurfacePixel& pixel) {
  return squared_norm(pixel.normal) > 0;
}

/// Looks up where points of one view are seen in another.
class Projector {
 public:
  Projector(const SurfaceView& target, const RigidTransform& T) : target_(target), T_(T) {}

  Vec3d place(const SurfacePixel& source) const { return T_(Vec3d(source.position)); }
  Vec3d turn(const SurfacePixel& source) const { return T_.rotate(Vec3d(source.normal)); }

  /// The pixel in which x is seen; null outside the image and behind the camera.
  const SurfacePixel* find(const Vec3d& x) const {
    const Camera& camera = target_.camera;
    if (!(x.z > 0)) return nullptr;
    const double inverse = 1 / x.z;
    const double u = camera.fx * x.x * inverse + camera.cx + 0.5;
    const double v = camera.fy * x.y * inverse + camera.cy + 0.5;
    if (!(u >= 0 && v >= 0 && u < camera.width && v < camera.height)) return nullptr;
    return &target_
                .pixels[static_cast<std::size_t>(v) * camera.width + static_cast<std::size_t>(u)];
  }

  /// The variance of the distance of two points across the surface, m^2.
  double variance(const SurfacePixel& a, const SurfacePixel& b) const {
    return square(a.sigma) + square(b.sigma) + square(a.bias) + square(b.bias) +
           square(kCurvature * b.position.z / target_.camera.fx);
  }

  static double square(double x) { return x * x; }

 private:
  const SurfaceView& target_;
  const RigidTransform& T_;
};

/// A point of the source, brought to the target, and the pixel that it is seen in.
struct Candidate {
  const SurfacePixel* source;
  const SurfacePixel* target;
  Vec3d place;
};

/// The candidates of every `step`-th pixel of one row. Looking all of them up before any is used
/// lets the processor fetch their pixels side by side: waiting for these is half of the time.
void look_up(const SurfacePixel* row, std::size_t width, std::size_t step,
             const Projector& projector, std::vector<Candidate>& candidates) {
  candidates.clear();
  for (std::size_t column = step / 2; column < width; column += step) {
    const SurfacePixel& s = row[column];
    if (!has_normal(s)) continue;
    const Vec3d x = projector.place(s);
    const SurfacePixel* const t = projector.find(x);
    if (!t) continue;
    __builtin_prefetch(t);
    candidates.push_back({&s, t, x});
  }
}

/// Adds a candidate to a pass whose residuals have the variance of the noise and `tolerance` more.
void add_residual(const Candidate& candidate, const Projector& projector, double tolerance,
                  NormalEquations& sums) {
  const SurfacePixel& t = *candidate.target;
  if (!has_normal(t)) return;
  const Vec3d n(t.normal);
  if (dot(n, projector.turn(*candidate.source)) < kLikeNormals) return;
  const double r = dot(n, candidate.place - Vec3d(t.position));
  const double variance = projector.variance(*candidate.source, t) + tolerance * tolerance;
  const double trust = tukey_weight(r * r / variance);
  if (!(trust > 0)) return;
  sums.add(moment_row(candidate.place, n), r, trust / variance);
  sums.weight += trust;
}

/// One pass: what every `step`-th row and column of the source asks for.
std::optional<NormalEquations> gather(const SurfaceView& source, const SurfaceView& target,
                                      const RigidTransform& T, std::size_t step, double tolerance,
                                      const Context& context) {
  const std::size_t width = source.camera.width, first = step / 2;
  const std::size_t rows = (source.camera.height + step - 1 - first) / step;
  const Projector projector(target, T);
  NormalEquations total;
  const bool complete = parallel_reduce(
      context, rows, total,
      [&](IndexRange range) {
        NormalEquations sums;
        std::vector<Candidate> candidates;
        candidates.reserve(width / step + 1);
        for (std::size_t row = range.begin; row < range.end; ++row) {
          const SurfacePixel* const pixels = source.pixels.data() + (first + row * step) * width;
          look_up(pixels, width, step, projector, candidates);
          for (const Candidate& c : candidates) add_residual(c, projector, tolerance, sums);
        }
        return sums;
      },
      [](NormalEquations& sum, const NormalEquations& part) { sum += part; }, kRowsAtOnce);
  if (!complete) return {};
  return total;
}

/// What the pixels of one view say of it in the other.
class Witness {
 public:
  Witness(const SurfaceView& source, const SurfaceView& target, const RigidTransform& T)
      : source_(source),
        projector_(target, T),
        normal_pixels_(std::max(source.normal_pixels, target.normal_pixels)),
        noise_pixels_(shared_noise()),
        bias_pixels_(kBiasPatch * static_cast<double>(target.pixels.size())) {}

  std::size_t block_rows() const { return (source_.camera.height + kBlock - 1) / kBlock; }

  Evidence row_of_blocks(std::size_t row) const {
    Evidence sum;
    for (std::size_t column = 0; column < source_.camera.width; column += kBlock) {
      sum += block(column, row * kBlock);
    }
    return sum;
  }

 private:
  Evidence block(std::size_t left, std::size_t top) const {
    Evidence sum;
    std::size_t in_front = 0;
    const std::size_t right = std::min<std::size_t>(left + kBlock, source_.camera.width);
    const std::size_t bottom = std::min<std::size_t>(top + kBlock, source_.camera.height);
    for (std::size_t row = top; row < bottom; row += kEvidenceStep) {
      for (std::size_t column = left; column < right; column += kEvidenceStep) {
        look(source_.pixels[row * source_.camera.width + column], sum, in_front);
      }
    }
    // Outlines are uncertain and only a pixel or two wide: what is seen through counts where it is
    // most of a patch.
    constexpr std::size_t kEnough = kBlock * kBlock / (4 * kEvidenceStep * kEvidenceStep);
    if (in_front >= kEnough && 2 * in_front > sum.compared) sum.contradicted += in_front;
    return sum;
  }

  void look(const SurfacePixel& s, Evidence& sum, std::size_t& in_front) const {
    if (!has_normal(s)) return;
    ++sum.points;
    const Vec3d x = projector_.place(s);
    const SurfacePixel* const t = projector_.find(x);
    if (!t || !has_normal(*t)) return;
    const Vec3d n(t->normal), m = projector_.turn(s);
    const double r = dot(n, x - Vec3d(t->position));
    const double variance = projector_.variance(s, *t);
    const double far = r / std::sqrt(variance);
    if (far < -kInlier) return;  // hidden behind what the target saw
    ++sum.compared;
    if (far > kInlier) {
      ++in_front;
    } else if (dot(n, m) >= kLikeNormals) {
      const double bias = Projector::square(s.bias) + Projector::square(t->bias);
      const double shared = (variance - bias) * noise_pixels_ + bias * bias_pixels_;
      sum.add_match(x, n, m, kEvidenceStep * kEvidenceStep / shared, far);
      sum.patches += kEvidenceStep * kEvidenceStep / normal_pixels_;
    }
  }

  const SurfaceView& source_;
  Projector projector_;
  double normal_pixels_, noise_pixels_, bias_pixels_;
};

std::optional<Evidence> gather_evidence(const SurfaceView& source, const SurfaceView& target,
                                        const RigidTransform& T, const Context& context) {
  const Witness witness(source, target, T);
  Evidence total;
  if (!parallel_reduce(
          context, witness.block_rows(), total,
          [&](IndexRange range) {
            Evidence sum;
            for (std::size_t row = range.begin; row < range.end; ++row) {
              sum += witness.row_of_blocks(row);
            }
            return sum;
          },
          [](Evidence& sum, const Evidence& part) { sum += part; }, 1)) {
    return {};
  }
  return total;
}

Result<void> check_input(const SurfaceView& source, const SurfaceView& target,
                         const RigidTransform& T) {
  for (const auto& [view, name] : {std::pair(&source, "source"), std::pair(&target, "target")}) {
    if (auto sound = check(*view); !sound) {
      return Error{sound.error().code, sound.error().message, name};
    }
  }
  return check_pose(T);
}

Result<void> judge_pose(const SurfaceView& source, const SurfaceView& target,
                        const AcceptanceParams& acceptance, const Context& context,
                        PairRegistration& pair) {
  const RigidTransform& T = pair.T_target_source;
  const RigidTransform back = T.inverse();
  const auto forward = gather_evidence(source, target, T, context.part(0, 0.5));
  if (!forward) return cancelled();
  const auto backward = gather_evidence(target, source, back, context.part(0.5, 1));
  if (!backward) return cancelled();
  judge(*forward, *backward, acceptance, pair);
  return {};
}

}  // namespace

const Schema<ProjectiveParams>& ProjectiveParams::schema() {
  using P = ProjectiveParams;
  static const auto schema =
      Schema<P>()
          .real("reach", &P::reach, more_than(0), "how far off the guess may put the surfaces",
                Quantity::length)
          .integer("step", &P::step, between(1, 64),
                   "every so-many-th row and column counts on the finest level")
          .integer("levels", &P::levels, between(1, 6),
                   "each coarser one takes every second of them")
          .integer("max_iterations", &P::max_iterations, between(1, 1000), "on each level")
          .group(&P::acceptance, AcceptanceParams::schema());
  return schema;
}

Result<PairRegistration> register_projective(const SurfaceView& source, const SurfaceView& target,
                                             const RigidTransform& T_target_source_guess,
                                             const ProjectiveParams& params,
                                             const Context& context) {
  if (auto valid = ProjectiveParams::schema().check(params); !valid) return valid.error();
  if (auto sound = check_input(source, target, T_target_source_guess); !sound) return sound.error();
  PairRegistration pair;
  RigidTransform& T = pair.T_target_source = T_target_source_guess;
  double tolerance = params.reach / kTukey;
  for (int level = params.levels - 1; level >= 0; --level) {
    const bool finest = level == 0;
    if (finest) tolerance = 0;
    pair.converged = false;
    const double begin = 0.9 * (params.levels - 1 - level) / params.levels;
    const double share = 0.9 / (params.levels * params.max_iterations);
    for (int i = 0; i < params.max_iterations && !pair.converged; ++i, ++pair.iterations) {
      const auto sums = gather(source, target, T, std::size_t(params.step) << level, tolerance,
                               context.part(begin + share * i, begin + share * (i + 1)));
      if (!sums) return cancelled();
      if (!finest && sums->count < kFewest) break;
      const auto step = solve(*sums, finest ? kFineDamping : kCoarseDamping);
      if (!step) break;
      T = moved(T, step->twist);
      pair.converged = is_still(*step, *sums, finest, shared_noise());
    }
    tolerance /= kGraduation;
  }
  if (auto judged = judge_pose(source, target, params.acceptance, context.part(0.9, 1), pair);
      !judged) {
    return judged.error();
  }
  return pair;
}

Result<PairRegistration> assess_projective(const SurfaceView& source, const SurfaceView& target,
                                           const RigidTransform& T_target_source,
                                           const AcceptanceParams& acceptance,
                                           const Context& context) {
  if (auto valid = AcceptanceParams::schema().check(acceptance); !valid) return valid.error();
  if (auto sound = check_input(source, target, T_target_source); !sound) return sound.error();
  PairRegistration pair;
  pair.T_target_source = T_target_source;
  pair.converged = true;
  if (auto judged = judge_pose(source, target, acceptance, context, pair); !judged) {
    return judged.error();
  }
  return pair;
}

}  // namespace burnish
