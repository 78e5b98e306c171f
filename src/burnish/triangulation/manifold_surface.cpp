#include "burnish/triangulation/manifold_surface.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace burnish {

ManifoldSurface::ManifoldSurface(std::span<const Vec3f> positions, std::span<const Vec3f> normals)
    : positions_(positions), normals_(normals), first_corner_(positions.size(), kNone) {
  triangles_.reserve(2 * positions.size());
  origin_.reserve(2 * positions.size());
  next_corner_.reserve(6 * positions.size());
}

template <class Visit>
void ManifoldSurface::for_each_link_edge(std::uint32_t v, Visit visit) const {
  for (std::uint32_t corner = first_corner_[v]; corner != kNone; corner = next_corner_[corner]) {
    const Triangle& t = triangles_[corner / 3];
    visit(LinkEdge{corner, t[(corner + 1) % 3], t[(corner + 2) % 3]});
  }
}

double ManifoldSurface::turn(std::uint32_t v, std::uint32_t w1, std::uint32_t w2) const {
  const Vec3d centre(positions_[v]);
  return dot(Vec3d(normals_[v]),
             cross(Vec3d(positions_[w1]) - centre, Vec3d(positions_[w2]) - centre));
}

/// The end of the link edge of v that begins at w.
std::uint32_t ManifoldSurface::successor(std::uint32_t v, std::uint32_t w) const {
  for (std::uint32_t corner = first_corner_[v]; corner != kNone; corner = next_corner_[corner]) {
    const Triangle& t = triangles_[corner / 3];
    if (t[(corner + 1) % 3] == w) return t[(corner + 2) % 3];
  }
  return kNone;
}

void ManifoldSurface::add(const Triangle& t, Origin origin) {
  const auto number = static_cast<std::uint32_t>(triangles_.size());
  suspect(t);
  triangles_.push_back(t);
  origin_.push_back(origin);
  for (std::uint32_t i = 0; i < 3; ++i) {
    next_corner_.push_back(first_corner_[t[i]]);
    first_corner_[t[i]] = 3 * number + i;
  }
}

bool ManifoldSurface::add_if_manifold(const Triangle& t, Origin origin) {
  for (std::size_t i = 0; i < 3; ++i) {
    if (!fits(t[i], t[(i + 1) % 3], t[(i + 2) % 3])) return false;
  }
  add(t, origin);
  return true;
}

/// Whether the link of v may take the edge from `begin` to `end`.
bool ManifoldSurface::fits(std::uint32_t v, std::uint32_t begin, std::uint32_t end) const {
  bool free = true;
  std::size_t degree = 0;
  for_each_link_edge(v, [&](const LinkEdge& link) {
    ++degree;
    free = free && link.begin != begin && link.end != end;
  });
  if (!free) return false;
  // The path that leaves `end` may come back to `begin` only as the whole link.
  std::size_t length = 0;
  for (std::uint32_t w = end; w != begin; ++length) {
    w = successor(v, w);
    if (w == kNone) return true;
  }
  return length == degree;
}

bool ManifoldSurface::overlaps(const Triangle& t) const {
  for (std::size_t i = 0; i < 3; ++i) {
    if (overlaps_at(t[i], t[(i + 1) % 3], t[(i + 2) % 3])) return true;
  }
  return false;
}

/// Sectors of less than half a turn overlap where one has a side of the other strictly inside.
bool ManifoldSurface::overlaps_at(std::uint32_t v, std::uint32_t begin, std::uint32_t end) const {
  if (!(turn(v, begin, end) > 0)) return true;
  const auto inside = [&](std::uint32_t w, std::uint32_t from, std::uint32_t to) {
    return w != from && w != to && turn(v, from, w) > 0 && turn(v, w, to) > 0;
  };
  bool overlap = false;
  for_each_link_edge(v, [&](const LinkEdge& link) {
    overlap = overlap || inside(link.begin, begin, end) || inside(link.end, begin, end) ||
              inside(begin, link.begin, link.end) || inside(end, link.begin, link.end);
  });
  return overlap;
}

bool ManifoldSurface::is_larger(std::uint32_t v, std::size_t count) const {
  std::vector<std::uint32_t> reached{v};
  for (std::size_t i = 0; i < reached.size() && reached.size() <= count; ++i) {
    for_each_link_edge(reached[i], [&](const LinkEdge& link) {
      for (const std::uint32_t w : {link.begin, link.end}) {
        if (std::find(reached.begin(), reached.end(), w) == reached.end()) reached.push_back(w);
      }
    });
  }
  return reached.size() > count;
}

void ManifoldSurface::remove(std::uint32_t triangle) {
  Triangle& t = triangles_[triangle];
  suspect(t);
  for (std::uint32_t i = 0; i < 3; ++i) {
    const std::uint32_t corner = 3 * triangle + i;
    std::uint32_t* link = &first_corner_[t[i]];
    while (*link != corner) link = &next_corner_[*link];
    *link = next_corner_[corner];
  }
  t = {kNone, kNone, kNone};
}

void ManifoldSurface::remove_piece(std::uint32_t v) {
  std::vector<std::uint32_t> left{v};
  while (!left.empty()) {
    const std::uint32_t w = left.back();
    if (!uses(w)) {
      left.pop_back();
      continue;
    }
    const std::uint32_t triangle = first_corner_[w] / 3;
    for (const std::uint32_t x : triangles_[triangle]) left.push_back(x);
    remove(triangle);
  }
}

/// The ends of the paths in the link of v: those without a predecessor, those without a successor;
/// each rising.
void ManifoldSurface::ends(std::uint32_t v, std::vector<std::uint32_t>& begins,
                           std::vector<std::uint32_t>& ends) const {
  begins.clear();
  ends.clear();
  for_each_link_edge(v, [&](const LinkEdge& link) {
    begins.push_back(link.begin);
    ends.push_back(link.end);
  });
  std::sort(begins.begin(), begins.end());
  std::sort(ends.begin(), ends.end());
  // What is in both lists is inside a path.
  auto kept_begin = begins.begin(), kept_end = ends.begin();
  auto b = begins.begin(), e = ends.begin();
  while (b != begins.end() || e != ends.end()) {
    if (e == ends.end() || (b != begins.end() && *b < *e)) {
      *kept_begin++ = *b++;
    } else if (b == begins.end() || *e < *b) {
      *kept_end++ = *e++;
    } else {
      ++b, ++e;
    }
  }
  begins.erase(kept_begin, begins.end());
  ends.erase(kept_end, ends.end());
}

void ManifoldSurface::suspect(const Triangle& t) {
  if (watching_) suspects_.insert(suspects_.end(), t.begin(), t.end());
}

/// Whether the link of v has an edge that ends where each begins.
bool ManifoldSurface::is_inner(std::uint32_t v) const {
  std::uint32_t sum = 0;  // of what begins less what ends: 0 for an inner vertex
  for_each_link_edge(v, [&](const LinkEdge& link) { sum += link.begin - link.end; });
  if (sum != 0) return false;
  bool inner = true;
  for_each_link_edge(
      v, [&](const LinkEdge& link) { inner = inner && successor(v, link.end) != kNone; });
  return inner;
}

std::vector<ManifoldSurface::Corner> ManifoldSurface::corners() {
  if (!watching_) {
    suspects_.resize(first_corner_.size());
    std::iota(suspects_.begin(), suspects_.end(), 0u);
    watching_ = true;
  } else {
    std::sort(suspects_.begin(), suspects_.end());
    suspects_.erase(std::unique(suspects_.begin(), suspects_.end()), suspects_.end());
  }
  std::erase_if(suspects_, [&](std::uint32_t v) { return is_inner(v); });
  std::vector<Corner> found;
  std::vector<std::uint32_t> from, to;
  for (const std::uint32_t v : suspects_) {
    ends(v, from, to);
    for (const std::uint32_t end : to) {
      // The first beginning counter-clockwise of the end: half turns first, then by cross product.
      const auto sooner = [&](std::uint32_t a, std::uint32_t b) {
        const bool left_a = turn(v, end, a) > 0, left_b = turn(v, end, b) > 0;
        return left_a != left_b ? left_a : turn(v, a, b) > 0;
      };
      std::size_t first = 0;
      for (std::size_t i = 1; i < from.size(); ++i) {
        if (sooner(from[i], from[first])) first = i;
      }
      found.push_back({v, from[first], end});
      from.erase(from.begin() + static_cast<std::ptrdiff_t>(first));
    }
  }
  return found;
}

void ManifoldSurface::paths(std::uint32_t v, std::vector<std::vector<std::uint32_t>>& found) const {
  std::vector<std::uint32_t> begins, stops;
  ends(v, begins, stops);
  found.assign(begins.size(), {});
  for (std::size_t i = 0; i < begins.size(); ++i) {
    std::uint32_t at = begins[i];
    for (bool moved = true; moved;) {
      moved = false;
      for_each_link_edge(v, [&](const LinkEdge& link) {
        if (moved || link.begin != at) return;
        found[i].push_back(link.corner / 3);
        at = link.end;
        moved = true;
      });
    }
  }
  std::stable_sort(found.begin(), found.end(),
                   [](const auto& a, const auto& b) { return a.size() > b.size(); });
}

void ManifoldSurface::triangles(std::vector<Triangle>& kept, std::vector<Origin>& origin) const {
  kept.clear();
  origin.clear();
  for (std::size_t t = 0; t < triangles_.size(); ++t) {
    if (triangles_[t][0] == kNone) continue;
    kept.push_back(triangles_[t]);
    origin.push_back(origin_[t]);
  }
}

}  // namespace burnish
