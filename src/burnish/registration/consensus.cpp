#include "burnish/registration/consensus.h"

#include <Eigen/LU>
#include <Eigen/SVD>
#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <limits>

#include "burnish/base/parallel.h"
#include "burnish/base/random.h"

namespace burnish {
namespace {

constexpr std::size_t kGrain = 64;
constexpr std::size_t kDrawsAtOnce = 1024;
constexpr std::size_t kKeptOfDraws = 40;
constexpr double kLongSide = 4;       // tolerances that the sides of a triple are long at least
constexpr double kLikeNormals = 0.8;  // cos 37 degrees
constexpr double kLikeTurn = 0.985;   // cos 10 degrees

float squared_distance(const Fpfh& a, const Fpfh& b) {
  float sum = 0;
  for (std::size_t i = 0; i < a.size(); ++i) sum += (a[i] - b[i]) * (a[i] - b[i]);
  return sum;
}

/// Which points have an uncommon histogram.
std::vector<std::uint32_t> uncommon(const std::vector<Fpfh>& features) {
  Fpfh mean{};
  for (const Fpfh& f : features) {
    for (std::size_t i = 0; i < mean.size(); ++i)
      mean[i] += f[i] / static_cast<float>(features.size());
  }
  std::vector<std::pair<float, std::uint32_t>> order;
  for (std::uint32_t i = 0; i < features.size(); ++i) {
    order.emplace_back(-squared_distance(features[i], mean), i);
  }
  std::sort(order.begin(), order.end());
  std::vector<std::uint32_t> result;
  for (std::size_t i = 0; i < (order.size() * 3 + 4) / 5; ++i) result.push_back(order[i].second);
  std::sort(result.begin(), result.end());
  return result;
}

/// The nearest of `others` in `b` for each of `which` in `a`.
std::optional<std::vector<std::uint32_t>> nearest(const std::vector<Fpfh>& a,
                                                  const std::vector<std::uint32_t>& which,
                                                  const std::vector<Fpfh>& b,
                                                  const std::vector<std::uint32_t>& others,
                                                  const Context& context) {
  std::vector<std::uint32_t> result(a.size(), std::numeric_limits<std::uint32_t>::max());
  const bool complete = parallel_for(
      context, which.size(),
      [&](IndexRange range) {
        for (std::size_t i = range.begin; i < range.end; ++i) {
          float best = std::numeric_limits<float>::infinity();
          for (const std::uint32_t j : others) {
            const float d = squared_distance(a[which[i]], b[j]);
            if (d < best) best = d, result[which[i]] = j;
          }
        }
      },
      kGrain);
  if (!complete) return {};
  return result;
}

using Triple = std::array<Correspondence, 3>;

/// The rotation and translation of least squares (Kabsch 1976).
RigidTransform pose_of(const OrientedPoints& source, const OrientedPoints& target,
                       const Triple& triple) {
  Vec3d a, b;
  for (const Correspondence& c : triple) {
    a += Vec3d(source.positions[c.source]) / 3;
    b += Vec3d(target.positions[c.target]) / 3;
  }
  Eigen::Matrix3d moments = Eigen::Matrix3d::Zero();
  for (const Correspondence& c : triple) {
    const Vec3d d = Vec3d(source.positions[c.source]) - a;
    const Vec3d e = Vec3d(target.positions[c.target]) - b;
    moments += Eigen::Vector3d(e.x, e.y, e.z) * Eigen::Vector3d(d.x, d.y, d.z).transpose();
  }
  const Eigen::JacobiSVD<Eigen::Matrix3d> svd(moments, Eigen::ComputeFullU | Eigen::ComputeFullV);
  Eigen::Vector3d signs(1, 1, 1);
  signs[2] = (svd.matrixU() * svd.matrixV().transpose()).determinant() < 0 ? -1 : 1;
  const Eigen::Matrix3d R = svd.matrixU() * signs.asDiagonal() * svd.matrixV().transpose();
  RigidTransform T;
  for (std::size_t i = 0; i < 3; ++i) {
    const auto row = static_cast<Eigen::Index>(i);
    T.rows[i] = {R(row, 0), R(row, 1), R(row, 2)};
  }
  T.translation = b - T.rotate(a);
  return T;
}

struct Sampler {
  const OrientedPoints &source, &target;
  const std::vector<Correspondence>& matches;
  double tolerance;

  bool like_sides(const Triple& triple) const {
    for (std::size_t i = 0; i < 3; ++i) {
      const Correspondence &a = triple[i], &b = triple[(i + 1) % 3];
      const double s = norm(Vec3d(source.positions[a.source]) - Vec3d(source.positions[b.source]));
      const double t = norm(Vec3d(target.positions[a.target]) - Vec3d(target.positions[b.target]));
      if (s < kLongSide * tolerance || std::abs(s - t) > tolerance) return false;
    }
    return true;
  }

  bool agrees(const Correspondence& c, const RigidTransform& T) const {
    const Vec3d d = T(Vec3d(source.positions[c.source])) - Vec3d(target.positions[c.target]);
    return squared_norm(d) < tolerance * tolerance &&
           dot(T.rotate(Vec3d(source.normals[c.source])), Vec3d(target.normals[c.target])) >
               kLikeNormals;
  }

  void draw(std::uint64_t seed, std::uint64_t number, std::vector<Hypothesis>& found) const {
    Random random(seed, number);
    Triple triple;
    for (Correspondence& c : triple) c = matches[random.below(matches.size())];
    if (!like_sides(triple)) return;
    const RigidTransform T = pose_of(source, target, triple);
    for (const Correspondence& c : triple) {
      if (!agrees(c, T)) return;
    }
    const auto score =
        std::count_if(matches.begin(), matches.end(), [&](const auto& c) { return agrees(c, T); });
    found.push_back({T, static_cast<double>(score)});
  }
};

/// The best first; of equals the one that was drawn first.
void keep_best(std::vector<Hypothesis>& found, std::size_t count) {
  std::stable_sort(found.begin(), found.end(),
                   [](const Hypothesis& a, const Hypothesis& b) { return a.score > b.score; });
  if (found.size() > count) found.resize(count);
}

}  // namespace

std::optional<std::vector<Correspondence>> mutual_matches(const std::vector<Fpfh>& source,
                                                          const std::vector<Fpfh>& target,
                                                          const Context& context) {
  const std::vector<std::uint32_t> from = uncommon(source), to = uncommon(target);
  const auto there = nearest(source, from, target, to, context.part(0, 0.5));
  if (!there) return {};
  const auto back = nearest(target, to, source, from, context.part(0.5, 1));
  if (!back) return {};
  std::vector<Correspondence> result;
  for (const std::uint32_t i : from) {
    const std::uint32_t j = (*there)[i];
    if (j < back->size() && (*back)[j] == i) result.push_back({i, j});
  }
  return result;
}

bool alike(const RigidTransform& a, const RigidTransform& b, const Vec3d& middle,
           double tolerance) {
  double trace = 0;
  for (std::size_t i = 0; i < 3; ++i) trace += dot(a.rows[i], b.rows[i]);
  return (trace - 1) / 2 > kLikeTurn && norm(a(middle) - b(middle)) < tolerance;
}

std::optional<std::vector<Hypothesis>> consensus(const OrientedPoints& source,
                                                 const OrientedPoints& target,
                                                 const std::vector<Correspondence>& matches,
                                                 double tolerance, std::size_t draws,
                                                 std::size_t wanted, const Context& context) {
  std::vector<Hypothesis> best;
  if (matches.size() < 3) return best;
  const Sampler sampler{source, target, matches, tolerance};
  const bool complete = parallel_reduce(
      context, draws, best,
      [&](IndexRange range) {
        std::vector<Hypothesis> found;
        for (std::size_t i = range.begin; i < range.end; ++i) sampler.draw(context.seed, i, found);
        keep_best(found, kKeptOfDraws);
        return found;
      },
      [](std::vector<Hypothesis>& all, std::vector<Hypothesis>&& found) {
        std::move(found.begin(), found.end(), std::back_inserter(all));
      },
      kDrawsAtOnce);
  if (!complete) return {};
  keep_best(best, best.size());
  Vec3d middle;
  for (const Vec3f& p : source.positions) middle += Vec3d(p);
  middle = middle / static_cast<double>(std::max<std::size_t>(source.size(), 1));
  std::vector<Hypothesis> unlike;
  for (const Hypothesis& h : best) {
    if (unlike.size() == wanted) break;
    const bool known = std::any_of(unlike.begin(), unlike.end(), [&](const Hypothesis& other) {
      return alike(h.T_target_source, other.T_target_source, middle, 2 * tolerance);
    });
    if (!known) unlike.push_back(h);
  }
  return unlike;
}

}  // namespace burnish
