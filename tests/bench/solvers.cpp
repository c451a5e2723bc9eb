// solvers CASE PLACE TYPE MERGED COUNT: how well the minimum of an edge is found, and how fast, by
// several solvers and in two forms of the quadric, on COUNT edges of a case: one of
// solver_cases.h, or FILE:FIELD. PLACE: OFFSET,UNIT,normalised or OFFSET,UNIT,plain. TYPE: float32
// or float64. MERGED: vertices that each end stands for. Prints a line of JSON per solver and form.
#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <limits>

#include <Eigen/Dense>

#include "ordered_source.h"
#include "registry.h"
#include "solver_cases.h"
#include "status.h"

namespace tetstream::bench {
namespace {

// What a solver says of an edge: the place from the middle, normalised, and the error there.
template <class S>
struct Answer {
  S z[kN], error;
};

constexpr size_t kLanes = static_cast<size_t>(kEdgeLanes);

// ------------------------------------------------------------------------- the library's kernels

template <class S>
struct ByGradients {
  static constexpr const char* kName = "CG";
  static constexpr const char* kForm = "A p e";
  static void solve(const CaseSet<S>& set, std::vector<Answer<S>>& out) {
    const QuadricKernels<S>& kernels = quadricKernels<S>(QuadricLayout::kFields, kN);
    for (size_t k = 0; k < set.edges.size(); ++k) {
      const EdgeCase<S>& e = set.edges[k];
      out[k].error = kernels.minimizeEdge(e.q1, e.x1, e.q2, e.x2, set.scale, kN, out[k].z);
    }
  }
};

template <class S>
struct ByElimination {
  static constexpr const char* kName = "LDLt, ridge";
  static constexpr const char* kForm = "A p e";
  static void solve(const CaseSet<S>& set, std::vector<Answer<S>>& out) {
    const QuadricKernels<S>& kernels = quadricKernels<S>(QuadricLayout::kFields, kN);
    for (size_t k = 0; k < set.edges.size(); ++k) {
      const EdgeCase<S>& e = set.edges[k];
      out[k].error = kernels.solveEdge(e.q1, e.x1, e.q2, e.x2, set.scale, kN, out[k].z);
    }
  }
};

// Eight edges at once. Their ends lie as in a window, one after the other.
template <class S>
struct ByEight {
  static constexpr const char* kName = "LDLt, ridge, by eight";
  static constexpr const char* kForm = "A p e";
  static void solve(const CaseSet<S>& set, std::vector<Answer<S>>& out) {
    constexpr int kQuadric = kPacked + 1;
    static std::vector<S> quadrics, values;
    static const CaseSet<S>* laid_out = nullptr;
    if (laid_out != &set) {  // a run has them so: no part of the solver's time
      quadrics.clear(), values.clear();
      for (const EdgeCase<S>& e : set.edges) {
        for (const S* q : {e.q1, e.q2}) quadrics.insert(quadrics.end(), q, q + kQuadric);
        for (const S* x : {e.x1, e.x2}) values.insert(values.end(), x, x + kN);
      }
      quadrics.resize(quadrics.size() + 3), values.resize(values.size() + 3);
      laid_out = &set;
    }
    const VertexTable<S> table = {quadrics.data(), values.data(), kQuadric, kN};
    for (size_t first = 0; first < set.edges.size(); first += kLanes) {
      const size_t count = std::min(kLanes, set.edges.size() - first);
      uint32_t ends[2 * kLanes];
      S z[kLanes * kN], errors[kLanes];
      for (size_t k = 0; k < 2 * count; ++k) ends[k] = static_cast<uint32_t>(2 * first + k);
      quadricKernels<S>(QuadricLayout::kFields, kN)
          .solveEdges(table, ends, static_cast<int>(count), set.scale, kN, z, errors);
      for (size_t k = 0; k < count; ++k) {
        std::copy_n(z + k * kN, kN, out[first + k].z);
        out[first + k].error = errors[k];
      }
    }
  }
};

// -------------------------------------------------------------------------- Eigen's solvers

template <class S>
using Square = Eigen::Matrix<S, kN, kN>;
template <class S>
using Vector = Eigen::Matrix<S, kN, 1>;

constexpr int at(int i, int j) {
  return i >= j ? i * (i + 1) / 2 + j : j * (j + 1) / 2 + i;
}
template <class S>
Square<S> squareOf(const S* packed) {
  Square<S> a;
  for (int i = 0; i < kN; ++i)
    for (int j = 0; j < kN; ++j) a(i, j) = packed[at(i, j)];
  return a;
}

struct Cholesky {
  static constexpr const char* kName = "Cholesky";
  template <class S>
  static Vector<S> solve(const Square<S>& a, const Vector<S>& r) {
    const Eigen::LLT<Square<S>> factors(a);
    if (factors.info() != Eigen::Success)
      return Vector<S>::Constant(std::numeric_limits<S>::quiet_NaN());
    return factors.solve(r);
  }
};
struct PivotedQr {
  static constexpr const char* kName = "QR, pivots";
  template <class S>
  static Vector<S> solve(const Square<S>& a, const Vector<S>& r) {
    return Eigen::ColPivHouseholderQR<Square<S>>(a).solve(r);
  }
};
struct Svd {
  static constexpr const char* kName = "SVD";
  template <class S>
  static Vector<S> solve(const Square<S>& a, const Vector<S>& r) {
    return Eigen::JacobiSVD<Square<S>>(a, Eigen::ComputeFullU | Eigen::ComputeFullV).solve(r);
  }
};
struct TruncatedSvd {
  static constexpr const char* kName = "SVD, condition 1e4";
  template <class S>
  static Vector<S> solve(const Square<S>& a, const Vector<S>& r) {
    Eigen::JacobiSVD<Square<S>> svd(a, Eigen::ComputeFullU | Eigen::ComputeFullV);
    svd.setThreshold(S(1 / kMaxCondition));
    return svd.solve(r);
  }
};

// Q = (x - p)^T A (x - p) + e of both ends: (A1 + A2) z = (A2 - A1) h.
template <class S, class Solver>
struct AtItsMinimum {
  static constexpr const char* kName = Solver::kName;
  static constexpr const char* kForm = "A p e";
  static void solve(const CaseSet<S>& set, std::vector<Answer<S>>& out) {
    for (size_t k = 0; k < set.edges.size(); ++k) {
      const EdgeCase<S>& e = set.edges[k];
      const Square<S> a1 = squareOf(e.q1), a2 = squareOf(e.q2);
      Vector<S> h;
      for (int i = 0; i < kN; ++i) h[i] = S(0.5) * ((e.x2[i] - e.x1[i]) * set.scale[i]);
      const Vector<S> z = Solver::solve(Square<S>(a1 + a2), Vector<S>((a2 - a1) * h));
      const Vector<S> d1 = z + h, d2 = z - h;
      std::copy_n(z.data(), kN, out[k].z);
      out[k].error = e.q1[kPacked] + e.q2[kPacked] + d1.dot(a1 * d1) + d2.dot(a2 * d2);
    }
  }
};

// Q = x^T A x - 2 b x + c about the origin, solved from the middle m, so that what A leaves open
// stays there: A z = b - A m.
template <class S, class Solver>
struct AboutTheOrigin {
  static constexpr const char* kName = Solver::kName;
  static constexpr const char* kForm = "A b c";
  static void solve(const CaseSet<S>& set, std::vector<Answer<S>>& out) {
    for (size_t k = 0; k < set.edges.size(); ++k) {
      const EdgeCase<S>& e = set.edges[k];
      const Square<S> a = squareOf(e.a);
      const Vector<S> b = Eigen::Map<const Vector<S>>(e.b),
                      m = Eigen::Map<const Vector<S>>(e.middle);
      const Vector<S> z = Solver::solve(a, Vector<S>(b - a * m)), x = m + z;
      std::copy_n(z.data(), kN, out[k].z);
      out[k].error = x.dot(a * x) - 2 * b.dot(x) + e.c;
    }
  }
};

// ------------------------------------------------------------------------------- how they do

double shareAt(std::vector<double> values, double share) {
  if (values.empty()) return std::nan("");
  std::sort(values.begin(), values.end());
  return values[std::min(values.size() - 1,
                         static_cast<size_t>(share * static_cast<double>(values.size())))];
}

struct Verdict {
  std::vector<double> off;     // from the nearest minimizer, in lengths of the edge
  std::vector<double> excess;  // of the error over the least, in those of the better end
  std::vector<double> told;  // error as the solver has it, off the true one at its place; likewise
  size_t not_finite = 0, far = 0, worse = 0, failed = 0;  // failed: any of them
};

constexpr double kFar = 10;  // edges from the middle: no place for the merged vertex
constexpr double kWorse = 1.001;

double number(Wide value) {
  return static_cast<double>(value);
}

// What S cannot tell from 0 there counts as nothing.
template <class S>
double unitOf(const ExactQuadric& exact) {
  Wide trace = 0, squared_length = 0;
  for (int i = 0; i < kN; ++i) {
    trace += exact.a[static_cast<size_t>(at(i, i))];
    squared_length += exact.half[static_cast<size_t>(i)] * exact.half[static_cast<size_t>(i)];
  }
  return std::max(number(exact.betterEnd()), double{std::numeric_limits<S>::epsilon()} *
                                                 number(trace) * number(squared_length));
}

template <class S>
void judge(const EdgeCase<S>& edge, const Answer<S>& answer, Verdict& verdict) {
  const ExactQuadric& exact = edge.exact;
  bool finite = std::isfinite(answer.error);
  WideVector z;
  double off = 0, moved = 0, length = 0;
  for (size_t i = 0; i < kN; ++i) {
    finite = finite && std::isfinite(answer.z[i]);
    z[i] = static_cast<Wide>(answer.z[i]);
    off += std::pow(number(z[i] - exact.nearest[i]), 2);
    moved += std::pow(number(z[i]), 2);
    length += std::pow(2 * number(exact.half[i]), 2);
  }
  if (!finite) {
    ++verdict.not_finite;
    ++verdict.failed;
    return;
  }
  const double unit = unitOf<S>(exact);
  const Wide there = exact.at(z);
  verdict.off.push_back(std::sqrt(off / length));
  verdict.excess.push_back(number(there - exact.least) / unit);
  verdict.told.push_back(std::fabs(number(static_cast<Wide>(answer.error) - there)) / unit);
  const bool is_far = moved > kFar * kFar * length, is_worse = number(there) > kWorse * unit;
  verdict.far += is_far;
  verdict.worse += is_worse;
  verdict.failed += is_far || is_worse;
}

double nowNs() {
  return std::chrono::duration<double, std::nano>(
             std::chrono::steady_clock::now().time_since_epoch())
      .count();
}

// The fastest of some rounds, each of a millisecond or so.
template <class Method, class S>
double nsPerEdge(const CaseSet<S>& set, std::vector<Answer<S>>& out) {
  double least = std::numeric_limits<double>::infinity();
  for (int round = 0; round < 7; ++round) {
    const double start = nowNs();
    int times = 0;
    do Method::solve(set, out);
    while (++times, nowNs() - start < 1e6);
    least = std::min(least, (nowNs() - start) / times / static_cast<double>(set.edges.size()));
  }
  return least;
}

template <class Method, class S>
void print(const CaseSet<S>& set) {
  std::vector<Answer<S>> out(set.edges.size());
  Method::solve(set, out);
  Verdict v;
  for (size_t k = 0; k < out.size(); ++k) judge(set.edges[k], out[k], v);
  const double percent = 100 / static_cast<double>(out.size());
  std::printf(
      "{\"solver\": \"%s\", \"form\": \"%s\", \"edges\": %zu, \"left_out\": %zu, "
      "\"not_finite\": %.6g, \"far\": %.6g, \"worse\": %.6g, \"failed\": %.6g",
      Method::kName, Method::kForm, out.size(), set.left_out,
      percent * static_cast<double>(v.not_finite), percent * static_cast<double>(v.far),
      percent * static_cast<double>(v.worse), percent * static_cast<double>(v.failed));
  const std::pair<const char*, const std::vector<double>&> measured[] = {
      {"off", v.off}, {"excess", v.excess}, {"told", v.told}};
  for (const auto& [name, values] : measured)
    if (!values.empty())
      std::printf(", \"%s_50\": %.6g, \"%s_99\": %.6g", name, shareAt(values, 0.5), name,
                  shareAt(values, 0.99));
  std::printf(", \"ns\": %.6g}\n", nsPerEdge<Method>(set, out));
}

template <class S, class... Solvers>
void printBothForms(const CaseSet<S>& set) {
  (print<AtItsMinimum<S, Solvers>>(set), ...);
  (print<AboutTheOrigin<S, Solvers>>(set), ...);
}

template <class S>
void printAll(const Mesh& mesh, const Place& place, size_t count, size_t merged) {
  const CaseSet<S> set = casesOf<S>(mesh, place, count, merged);
  if (set.edges.empty()) return;  // all cells are flat there
  print<ByGradients<S>>(set);
  print<ByElimination<S>>(set);
  print<ByEight<S>>(set);
  printBothForms<S, Cholesky, PivotedQr, Svd, TruncatedSvd>(set);
}

// ------------------------------------------------------------------------------- what is asked

// The mesh of a file, with the first component of a field.
Mesh meshOf(const std::string& path, const std::string& field) {
  Input input = needFormat("", path).open(openFile(path.c_str()), {});
  std::unique_ptr<Source> ordered;
  if (!input.stream) ordered = std::make_unique<OrderedSource>(*input.indexed, OrderOptions());
  Source& source = ordered ? *ordered : *input.stream;
  const Schema& schema = source.schema();
  size_t column = 0;
  while (column < schema.fields.size() && schema.fields[column].name != field) ++column;
  if (column == schema.fields.size())
    fail(Status::kBadArgument, "%s has no field %s", path.c_str(), field.c_str());
  const Column& of = schema.fields[column];
  Mesh mesh;
  std::vector<double> positions, values;
  BatchView batch;
  while (source.next(batch)) {
    const size_t rows = batch.vertex_count, components = static_cast<size_t>(of.components);
    positions.resize(3 * rows), values.resize(components * rows);
    if (rows) {
      convertScalars(batch.positions, schema.position_type, positions.data(), ScalarType::kFloat64,
                     3 * rows);
      convertScalars(batch.fields[column], of.type, values.data(), ScalarType::kFloat64,
                     components * rows);
    }
    for (size_t v = 0; v < rows; ++v) {
      mesh.points.push_back({positions[3 * v], positions[3 * v + 1], positions[3 * v + 2]});
      mesh.field.push_back(values[components * v]);
    }
    for (size_t c = 0; c < batch.cell_count; ++c) {
      std::array<uint32_t, 4> cell;
      for (size_t j = 0; j < 4; ++j) cell[j] = static_cast<uint32_t>(batch.cells[4 * c + j]);
      mesh.cells.push_back(cell);
    }
  }
  if (mesh.cells.empty()) fail(Status::kBadData, "there are no cells in %s", path.c_str());
  return mesh;
}

Place placeOf(const std::string& text) {
  const size_t first = text.find(','), second = text.find(',', first + 1);
  const std::string kind = second == std::string::npos ? "" : text.substr(second + 1);
  if (kind != "normalised" && kind != "plain")
    fail(Status::kBadArgument, "no OFFSET,UNIT,normalised nor OFFSET,UNIT,plain: %s", text.c_str());
  return {text, std::atof(text.c_str()), std::atof(text.c_str() + first + 1), kind == "normalised"};
}

void run(char** words) {
  const std::string name = words[0], type = words[2];
  const size_t colon = name.rfind(':');
  const Mesh mesh = colon == std::string::npos
                        ? syntheticMesh(name)
                        : meshOf(name.substr(0, colon), name.substr(colon + 1));
  const Place place = placeOf(words[1]);
  const auto merged = static_cast<size_t>(std::max(std::atoi(words[3]), 1));
  const auto count = static_cast<size_t>(std::max(std::atoi(words[4]), 1));
  if (type == "float32")
    printAll<float>(mesh, place, count, merged);
  else if (type == "float64")
    printAll<double>(mesh, place, count, merged);
  else
    fail(Status::kBadArgument, "neither float32 nor float64: %s", type.c_str());
}

}  // namespace
}  // namespace tetstream::bench

int main(int argc, char** argv) {
  if (argc != 6) {
    std::fputs("usage: solvers CASE PLACE TYPE MERGED COUNT\n", stderr);
    return 1;
  }
  try {
    tetstream::bench::run(argv + 1);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "solvers: %s\n", error.what());
    return 1;
  }
  return 0;
}
