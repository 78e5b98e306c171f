#include "burnish/adaptation/half_edges.h"

#include <algorithm>
#include <utility>

#include "burnish/base/parallel.h"

namespace burnish {

HalfEdges::HalfEdges(std::size_t vertices, const std::vector<Triangle>& triangles,
                     const Context& context)
    : origin_(3 * triangles.size()),
      twin_(3 * triangles.size()),
      out_(vertices, kNone),
      kind_(vertices, Kind::inner),
      marked_(vertices, 0),
      live_(triangles.size()) {
  for (std::size_t t = 0; t < triangles.size(); ++t) {
    for (std::size_t i = 0; i < 3; ++i) origin_[3 * t + i] = triangles[t][i];
  }
  LargeVector<Index> offsets(vertices + 1, 0), leaving(origin_.size());
  for (const Index v : origin_) ++offsets[v + 1];
  for (std::size_t v = 0; v < vertices; ++v) offsets[v + 1] += offsets[v];
  LargeVector<Index> place(offsets.begin(), offsets.end() - 1);
  for (Index h = 0; h < origin_.size(); ++h) leaving[place[origin_[h]]++] = h;

  Context quiet = context;
  quiet.sink = nullptr;
  const Adjacency rows(std::move(offsets), std::move(leaving));
  if (!pair_up(rows, quiet)) return;
  find_kinds(rows);
}

/// Finds the twin of each half-edge in the row of its head; kAmbiguous where there are several.
bool HalfEdges::pair_up(const Adjacency& leaving, const Context& context) {
  return parallel_for(context, origin_.size(), [&](IndexRange range) {
    for (std::size_t i = range.begin; i < range.end; ++i) {
      const auto h = static_cast<Index>(i);
      const Index a = origin(h), b = head(h);
      int along = 0, against = 0;
      for (const Index other : leaving.row(a)) along += head(other) == b;
      twin_[h] = kNone;
      for (const Index other : leaving.row(b)) {
        if (head(other) != a) continue;
        twin_[h] = other;
        ++against;
      }
      if (along > 1 || against > 1 || a == b || a == apex(h)) twin_[h] = kAmbiguous;
    }
  });
}

void HalfEdges::find_kinds(const Adjacency& leaving) {
  for (Index h = 0; h < origin_.size(); ++h) {
    if (twin_[h] == kAmbiguous) {
      kind_[origin(h)] = kind_[head(h)] = kind_[apex(h)] = Kind::locked;
      twin_[h] = kNone;
    } else if (twin_[h] != kNone && twin_[twin_[h]] != h) {
      twin_[h] = kNone;
    }
  }
  for (Index v = 0; v < kind_.size(); ++v) {
    const auto row = leaving.row(v);
    if (row.empty()) kind_[v] = Kind::locked;
    if (kind_[v] == Kind::locked) continue;
    out_[v] = row[0];
    for (const Index h : row) {
      if (twin_[h] == kNone) out_[v] = h;
    }
    // Where there are several fans, going around from one half-edge does not meet all of them.
    std::size_t met = 0;
    for_each_from(v, [&](Index) { ++met; });
    if (met != row.size()) {
      kind_[v] = Kind::locked;
    } else if (twin_[out_[v]] == kNone) {
      kind_[v] = Kind::boundary;
    }
  }
}

HalfEdges::Merge HalfEdges::ends_that_may_go(Index h) const {
  const Kind a = kind_[origin(h)], b = kind_[head(h)];
  if (a == Kind::locked || b == Kind::locked) return {};
  const bool along_boundary = twin_[h] == kNone;
  return {a == Kind::inner || along_boundary, b == Kind::inner || along_boundary};
}

bool HalfEdges::keeps_surface(Index h) {
  // An apex whose other two edges lead to one triangle would keep two triangles back to back; one
  // whose other two edges are boundaries would keep none.
  int apexes = 0;
  for (const Index side : {h, twin_[h]}) {
    if (side == kNone) continue;
    ++apexes;
    const Index x = twin_[next(side)], y = twin_[previous(side)];
    if (x == kNone && y == kNone) return false;
    if (x != kNone && y != kNone && apex(x) == apex(y)) return false;
  }

  // Neighbours of both ends other than the apexes would get a second edge to the merged vertex.
  if (++query_ == 0) {
    std::fill(marked_.begin(), marked_.end(), 0);
    query_ = 1;
  }
  const auto for_each_neighbour = [this](Index v, auto visit) {
    Index last = kNone;
    for_each_from(v, [&](Index from) {
      visit(head(from));
      last = from;
    });
    if (twin_[previous(last)] == kNone) visit(apex(last));
  };
  for_each_neighbour(origin(h), [this](Index v) { marked_[v] = query_; });
  int shared = 0;
  for_each_neighbour(head(h), [&](Index v) { shared += marked_[v] == query_; });
  return shared == apexes;
}

void HalfEdges::collapse(Index h, bool head_goes) {
  const Index goes = head_goes ? head(h) : origin(h), stays = head_goes ? origin(h) : head(h);
  const Index goes_out = out_[goes];
  const Index sides[] = {h, twin_[h]};
  for_each_from(goes, [&](Index from) { origin_[from] = stays; });

  for (const Index side : sides) {
    if (side == kNone) continue;
    const Index x = next(side), y = previous(side), tip = origin(y);
    const Index beyond_x = twin_[x], beyond_y = twin_[y];
    if (beyond_x != kNone) twin_[beyond_x] = beyond_y;
    if (beyond_y != kNone) twin_[beyond_y] = beyond_x;
    if (out_[tip] == y) out_[tip] = beyond_x;
    if (kind_[stays] == Kind::inner) {
      out_[stays] = beyond_y;
    } else if (out_[stays] == side) {
      out_[stays] = goes_out == x ? beyond_y : goes_out;
    } else if (out_[stays] == x) {
      out_[stays] = beyond_y;
    }
    --live_;
  }
  for (const Index side : sides) {
    if (side == kNone) continue;
    const Index first = side - side % 3;
    origin_[first] = origin_[first + 1] = origin_[first + 2] = kNone;
  }
  kind_[goes] = Kind::gone;
}

LargeVector<HalfEdges::Index> HalfEdges::compact() {
  LargeVector<Index> renamed(triangles()), kept;
  kept.reserve(live_);
  for (Index t = 0; t < triangles(); ++t) {
    renamed[t] = static_cast<Index>(kept.size());
    if (is_live(t)) kept.push_back(t);
  }
  const auto rename = [&](Index h) { return h == kNone ? kNone : 3 * renamed[h / 3] + h % 3; };
  for (std::size_t t = 0; t < kept.size(); ++t) {
    for (std::size_t i = 0; i < 3; ++i) {
      const std::size_t to = 3 * t + i, from = 3 * std::size_t{kept[t]} + i;
      origin_[to] = origin_[from];
      twin_[to] = rename(twin_[from]);
    }
  }
  for (std::size_t v = 0; v < out_.size(); ++v) {
    if (kind_[v] == Kind::inner || kind_[v] == Kind::boundary) out_[v] = rename(out_[v]);
  }
  origin_.resize(3 * kept.size());
  twin_.resize(3 * kept.size());
  return kept;
}

}  // namespace burnish
