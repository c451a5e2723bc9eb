// vtk_decimate IN.vtu FIELD KEEP plain|scaled OUT.vtu: VTK's vtkUnstructuredGridQuadricDecimation
// on one mesh and scalar field, for comparison. It keeps about KEEP times the cells.
//
// "scaled" does what a user who knows the filter would do: its thresholds are absolute and it does
// not normalise, so coordinates are centred at the origin and divided by the mean length of the
// edges, the field is centred at zero and scaled so that its range is the diagonal of the box, and
// both are undone afterwards. Prints one JSON object; the times are those of Update() alone.

#include <vtkCellArray.h>
#include <vtkDataArray.h>
#include <vtkDoubleArray.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkSmartPointer.h>
#include <vtkUnstructuredGrid.h>
#include <vtkUnstructuredGridQuadricDecimation.h>
#include <vtkXMLUnstructuredGridReader.h>
#include <vtkXMLUnstructuredGridWriter.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <string>
#include <vector>

namespace {

// x -> (x - from) / by.
struct Scale {
  double from[3] = {0, 0, 0};
  double by = 1;
  double field_from = 0, field_by = 1;
};

struct Timing {
  double wall, processor;
  int kept;
};

// Cells with their corners, in the order of the grid; other cells are left out.
vtkNew<vtkCellArray> cellsOf(vtkUnstructuredGrid* grid) {
  vtkNew<vtkCellArray> cells;
  for (vtkIdType c = 0; c < grid->GetNumberOfCells(); ++c) {
    if (grid->GetCellType(c) != VTK_TETRA) continue;
    vtkIdType count;
    const vtkIdType* corners;
    grid->GetCellPoints(c, count, corners);
    cells->InsertNextCell(count, corners);
  }
  return cells;
}

// The tetrahedra of `grid` and the vertices that they use, in the order of the grid.
vtkSmartPointer<vtkUnstructuredGrid> tetrahedraOf(vtkUnstructuredGrid* grid, vtkDataArray* field) {
  vtkNew<vtkCellArray> cells = cellsOf(grid);
  vtkDataArray* corners = cells->GetConnectivityArray();
  std::vector<vtkIdType> rank(static_cast<size_t>(grid->GetNumberOfPoints()), -1);
  for (vtkIdType k = 0; k < corners->GetNumberOfTuples(); ++k)
    rank[static_cast<size_t>(corners->GetTuple1(k))] = 0;
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  vtkNew<vtkDoubleArray> values;
  values->SetName("field");
  for (size_t v = 0; v < rank.size(); ++v) {
    if (rank[v] < 0) continue;
    rank[v] = points->InsertNextPoint(grid->GetPoint(static_cast<vtkIdType>(v)));
    values->InsertNextValue(field->GetTuple1(static_cast<vtkIdType>(v)));
  }
  for (vtkIdType k = 0; k < corners->GetNumberOfTuples(); ++k)
    corners->SetTuple1(k, static_cast<double>(rank[static_cast<size_t>(corners->GetTuple1(k))]));
  auto result = vtkSmartPointer<vtkUnstructuredGrid>::New();
  result->SetPoints(points);
  result->SetCells(VTK_TETRA, cells);
  result->GetPointData()->SetScalars(values);
  return result;
}

// The mean length of the six edges of every cell: inner edges count once for each cell around.
double meanEdge(vtkUnstructuredGrid* grid) {
  double sum = 0;
  for (vtkIdType c = 0; c < grid->GetNumberOfCells(); ++c) {
    vtkIdType count;
    const vtkIdType* corners;
    grid->GetCellPoints(c, count, corners);
    double p[4][3];
    for (int k = 0; k < 4; ++k) grid->GetPoint(corners[k], p[k]);
    for (int a = 0; a < 4; ++a)
      for (int b = a + 1; b < 4; ++b)
        sum += std::hypot(p[a][0] - p[b][0], p[a][1] - p[b][1], p[a][2] - p[b][2]);
  }
  return sum / (6.0 * static_cast<double>(grid->GetNumberOfCells()));
}

Scale scaleOf(vtkUnstructuredGrid* grid) {
  Scale scale;
  double box[6], range[2];
  grid->GetBounds(box);
  grid->GetPointData()->GetScalars()->GetRange(range);
  for (int axis = 0; axis < 3; ++axis) scale.from[axis] = (box[2 * axis] + box[2 * axis + 1]) / 2;
  scale.by = meanEdge(grid);
  const double diagonal = std::hypot(box[1] - box[0], box[3] - box[2], box[5] - box[4]) / scale.by;
  scale.field_from = (range[0] + range[1]) / 2;
  scale.field_by = range[1] > range[0] ? (range[1] - range[0]) / diagonal : 1;
  return scale;
}

void scaleDown(vtkUnstructuredGrid* grid, const Scale& scale) {
  vtkPoints* points = grid->GetPoints();
  vtkDataArray* field = grid->GetPointData()->GetScalars();
  for (vtkIdType v = 0; v < grid->GetNumberOfPoints(); ++v) {
    double p[3];
    points->GetPoint(v, p);
    for (int axis = 0; axis < 3; ++axis) p[axis] = (p[axis] - scale.from[axis]) / scale.by;
    points->SetPoint(v, p);
    field->SetTuple1(v, (field->GetTuple1(v) - scale.field_from) / scale.field_by);
  }
  points->Modified();
  grid->Modified();
}

// In double precision, whatever the filter gave.
vtkSmartPointer<vtkUnstructuredGrid> scaledUp(vtkUnstructuredGrid* grid, const Scale& scale,
                                              const char* name) {
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  vtkNew<vtkDoubleArray> values;
  values->SetName(name);
  vtkDataArray* field = grid->GetPointData()->GetScalars();
  for (vtkIdType v = 0; v < grid->GetNumberOfPoints(); ++v) {
    double p[3];
    grid->GetPoint(v, p);
    for (int axis = 0; axis < 3; ++axis) p[axis] = p[axis] * scale.by + scale.from[axis];
    points->InsertNextPoint(p);
    values->InsertNextValue(field->GetTuple1(v) * scale.field_by + scale.field_from);
  }
  auto result = vtkSmartPointer<vtkUnstructuredGrid>::New();
  result->SetPoints(points);
  result->SetCells(VTK_TETRA, grid->GetCells());
  result->GetPointData()->SetScalars(values);
  return result;
}

Timing decimate(vtkUnstructuredGridQuadricDecimation* filter, vtkUnstructuredGrid* grid,
                double keep) {
  const double cells = static_cast<double>(grid->GetNumberOfCells());
  filter->SetInputData(grid);
  filter->SetScalarsName("field");
  filter->SetNumberOfTetsOutput(static_cast<int>(std::floor(keep * cells)));
  const auto begin = std::chrono::steady_clock::now();
  const std::clock_t processor = std::clock();
  filter->Update();
  const std::chrono::duration<double> wall = std::chrono::steady_clock::now() - begin;
  return {wall.count(), static_cast<double>(std::clock() - processor) / CLOCKS_PER_SEC,
          static_cast<int>(filter->GetOutput()->GetNumberOfCells())};
}

// Null if there is no such field of one component.
vtkSmartPointer<vtkUnstructuredGrid> read(const char* path, const char* name) {
  vtkNew<vtkXMLUnstructuredGridReader> reader;
  reader->SetFileName(path);
  reader->Update();
  vtkDataArray* field = reader->GetOutput()->GetPointData()->GetArray(name);
  if (!field || field->GetNumberOfComponents() != 1) return nullptr;
  return tetrahedraOf(reader->GetOutput(), field);
}

bool write(vtkUnstructuredGrid* grid, const char* path) {
  vtkNew<vtkXMLUnstructuredGridWriter> writer;
  writer->SetFileName(path);
  writer->SetInputData(grid);
  writer->SetDataModeToAppended();
  writer->EncodeAppendedDataOff();
  return writer->Write() != 0;
}

int fail(const std::string& sentence) {
  std::fprintf(stderr, "vtk_decimate: %s\n", sentence.c_str());
  return 1;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 6) return fail("usage: vtk_decimate IN.vtu FIELD KEEP plain|scaled OUT.vtu");
  const std::string name = argv[2], variant = argv[4];
  const double keep = std::strtod(argv[3], nullptr);
  if (!(keep > 0 && keep < 1)) return fail("KEEP must lie between 0 and 1");
  if (variant != "plain" && variant != "scaled")
    return fail("neither plain nor scaled: " + variant);

  vtkSmartPointer<vtkUnstructuredGrid> grid = read(argv[1], name.c_str());
  if (!grid) return fail("no scalar field " + name + " in " + argv[1]);
  const vtkIdType cells = grid->GetNumberOfCells();
  const Scale scale = variant == "scaled" ? scaleOf(grid) : Scale();
  scaleDown(grid, scale);

  vtkNew<vtkUnstructuredGridQuadricDecimation> filter;
  const Timing timing = decimate(filter, grid, keep);
  vtkSmartPointer<vtkUnstructuredGrid> result = scaledUp(filter->GetOutput(), scale, name.c_str());
  if (!write(result, argv[5])) return fail(std::string("cannot write ") + argv[5]);
  std::printf("{\"cells_in\": %lld, \"cells_out\": %d, \"seconds\": %.6f, \"cpu_seconds\": %.6f}\n",
              static_cast<long long>(cells), timing.kept, timing.wall, timing.processor);
  return 0;
}
