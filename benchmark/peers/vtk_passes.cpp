#include <vtkCellArray.h>
#include <vtkNew.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkSmoothPolyDataFilter.h>

#include "passes_peer.h"
#include "vtk_rings.h"

// The mean is vtkSmoothPolyDataFilter: what it takes for one pass counts as its adjacency. Eq. 1 is
// a loop over the rings from BuildLinks.

static void smooth(vtkPolyData* mesh, int passes) {
  vtkNew<vtkSmoothPolyDataFilter> filter;
  filter->SetInputData(mesh);
  filter->SetNumberOfIterations(passes);
  filter->SetRelaxationFactor(1);
  filter->SetConvergence(0);
  filter->FeatureEdgeSmoothingOff();
  filter->BoundarySmoothingOff();
  filter->Update();
}

int main(int argc, char** argv) {
  const bool equation = wants_equation1(argc, argv);
  const PlainMesh plain = read_plain_mesh(argv[1]);
  vtkNew<vtkPoints> points;
  for (const auto& p : plain.positions) points->InsertNextPoint(p.data());
  vtkNew<vtkCellArray> cells;
  for (const auto& t : plain.triangles) {
    const vtkIdType corners[3] = {t[0], t[1], t[2]};
    cells->InsertNextCell(3, corners);
  }
  vtkNew<vtkPolyData> mesh;
  mesh->SetPoints(points);
  mesh->SetPolys(cells);
  const Stopwatch first;
  if (equation) {
    const auto neighbours = rings(mesh);
    first.print();
    const Stopwatch passes;
    equation1_passes(mesh, neighbours, kPasses);
    passes.print();
  } else {
    smooth(mesh, kPasses);
    const Seconds all = first.seconds();
    const Stopwatch second;
    smooth(mesh, 1);
    const Seconds one = second.seconds();
    one.print();
    (all - one).print();
  }
}
