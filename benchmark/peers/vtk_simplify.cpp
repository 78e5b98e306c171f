#include <vtkCellArray.h>
#include <vtkDecimatePro.h>
#include <vtkIdList.h>
#include <vtkNew.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkQuadricDecimation.h>

#include "simplify_peer.h"

// simplify_vtk MESH OUT.ply TRIANGLES quadric|pro: vtkQuadricDecimation with its defaults, or
// vtkDecimatePro that keeps the topology.
static PlainMesh plain_of(vtkPolyData* data) {
  PlainMesh plain;
  plain.positions.resize(static_cast<std::size_t>(data->GetNumberOfPoints()));
  double p[3];
  for (std::size_t v = 0; v < plain.positions.size(); ++v) {
    data->GetPoint(static_cast<vtkIdType>(v), p);
    plain.positions[v] = {static_cast<float>(p[0]), static_cast<float>(p[1]),
                          static_cast<float>(p[2])};
  }
  vtkCellArray* cells = data->GetPolys();
  vtkNew<vtkIdList> corners;
  cells->InitTraversal();
  while (cells->GetNextCell(corners)) {
    auto& triangle = plain.triangles.emplace_back();
    for (int i = 0; i < 3; ++i) {
      triangle[static_cast<std::size_t>(i)] = static_cast<std::uint32_t>(corners->GetId(i));
    }
  }
  return plain;
}

template <class Filter>
static PlainMesh run(Filter* filter, vtkPolyData* data, double reduction,
                     Measurement& measurement) {
  filter->SetInputData(data);
  filter->SetTargetReduction(reduction);
  measurement.begin_alone();
  filter->Update();
  measurement.end_alone();
  return plain_of(filter->GetOutput());
}

int main(int argc, char** argv) {
  if (argc != 5) return 2;
  const bool pro = std::string(argv[4]) == "pro";
  return run_simplify_peer(
      argv, [pro](const PlainMesh& plain, std::size_t triangles, Measurement& measurement) {
        vtkNew<vtkPoints> points;
        points->Allocate(static_cast<vtkIdType>(plain.positions.size()));
        for (const auto& p : plain.positions) points->InsertNextPoint(p.data());
        vtkNew<vtkCellArray> cells;
        cells->AllocateExact(static_cast<vtkIdType>(plain.triangles.size()),
                             static_cast<vtkIdType>(3 * plain.triangles.size()));
        for (const auto& [a, b, c] : plain.triangles) {
          const vtkIdType corners[3] = {a, b, c};
          cells->InsertNextCell(3, corners);
        }
        vtkNew<vtkPolyData> data;
        data->SetPoints(points);
        data->SetPolys(cells);
        const double reduction =
            1 - static_cast<double>(triangles) / static_cast<double>(plain.triangles.size());
        if (pro) {
          vtkNew<vtkDecimatePro> filter;
          filter->PreserveTopologyOn();
          return run(filter.Get(), data, reduction, measurement);
        }
        vtkNew<vtkQuadricDecimation> filter;
        return run(filter.Get(), data, reduction, measurement);
      });
}
