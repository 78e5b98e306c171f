#pragma once

#include <vtkIdList.h>
#include <vtkNew.h>
#include <vtkPolyData.h>
#include <vtkVector.h>

#include <algorithm>
#include <vector>

#include "equation1.h"

// Eq. 1 on VTK's own mesh and links.

/// The distinct vertices of the cells around each point, none for points on a boundary.
inline std::vector<std::vector<vtkIdType>> rings(vtkPolyData* mesh) {
  mesh->BuildLinks();
  std::vector<std::vector<vtkIdType>> result(static_cast<std::size_t>(mesh->GetNumberOfPoints()));
  vtkNew<vtkIdList> cells, points;
  for (vtkIdType p = 0; p < mesh->GetNumberOfPoints(); ++p) {
    std::vector<vtkIdType> found;
    mesh->GetPointCells(p, cells);
    for (vtkIdType c = 0; c < cells->GetNumberOfIds(); ++c) {
      mesh->GetCellPoints(cells->GetId(c), points);
      for (vtkIdType i = 0; i < points->GetNumberOfIds(); ++i) {
        if (points->GetId(i) != p) found.push_back(points->GetId(i));
      }
    }
    std::sort(found.begin(), found.end());
    // An inner edge is in two cells: each neighbour comes twice.
    bool inner = found.size() % 2 == 0;
    for (std::size_t i = 0; inner && i < found.size(); i += 2) inner = found[i] == found[i + 1];
    found.erase(std::unique(found.begin(), found.end()), found.end());
    if (inner) result[static_cast<std::size_t>(p)] = std::move(found);
  }
  return result;
}

inline vtkVector3d point_of(vtkPoints* points, vtkIdType i) {
  vtkVector3d p;
  points->GetPoint(i, p.GetData());
  return p;
}

/// vtkVector3d adds and subtracts by free functions, which the shared arithmetic wants as members.
struct Point : vtkVector3d {
  Point(const vtkVector3d& p) : vtkVector3d(p) {}
  Point& operator+=(const Point& q) {
    for (int i = 0; i < 3; ++i) (*this)[i] += q[i];
    return *this;
  }
  Point operator-(const Point& q) const {
    return vtkVector3d((*this)[0] - q[0], (*this)[1] - q[1], (*this)[2] - q[2]);
  }
  Point operator*(double s) const {
    return vtkVector3d((*this)[0] * s, (*this)[1] * s, (*this)[2] * s);
  }
};

inline void equation1_passes(vtkPolyData* mesh,
                             const std::vector<std::vector<vtkIdType>>& neighbours, int passes) {
  vtkPoints* points = mesh->GetPoints();
  vtkNew<vtkPoints> next;
  next->DeepCopy(points);
  for (int pass = 0; pass < passes; ++pass) {
    for (std::size_t v = 0; v < neighbours.size(); ++v) {
      const Point p = equation1(
          Point(point_of(points, static_cast<vtkIdType>(v))), neighbours[v],
          [&](vtkIdType w) { return Point(point_of(points, w)); },
          [](const Point& d) { return d.SquaredNorm(); });
      next->SetPoint(static_cast<vtkIdType>(v), p.GetData());
    }
    points->DeepCopy(next);
  }
}
