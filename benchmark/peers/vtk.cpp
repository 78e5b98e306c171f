#include <vtkCellArray.h>
#include <vtkNew.h>
#include <vtkPLYReader.h>
#include <vtkPLYWriter.h>
#include <vtkPolyData.h>
#include <vtkSmoothPolyDataFilter.h>

#include <cstring>

#include "vtk_rings.h"

// peer_vtk IN OUT equation1|own: ten passes, boundaries fixed in equation1.

int main(int argc, char** argv) {
  if (argc != 4) return 2;
  vtkNew<vtkPLYReader> reader;
  reader->SetFileName(argv[1]);
  reader->Update();
  vtkSmartPointer<vtkPolyData> mesh = reader->GetOutput();
  if (mesh->GetNumberOfPoints() == 0) return 1;
  if (std::strcmp(argv[3], "equation1") == 0) {
    equation1_passes(mesh, rings(mesh), 10);
  } else {
    vtkNew<vtkSmoothPolyDataFilter> filter;
    filter->SetInputData(mesh);
    filter->SetNumberOfIterations(10);
    filter->SetRelaxationFactor(1);
    filter->FeatureEdgeSmoothingOff();
    filter->BoundarySmoothingOff();
    filter->Update();
    mesh = filter->GetOutput();
  }
  vtkNew<vtkPLYWriter> writer;
  writer->SetFileName(argv[2]);
  writer->SetInputData(mesh);
  writer->SetFileTypeToBinary();
  return writer->Write() ? 0 : 1;
}
