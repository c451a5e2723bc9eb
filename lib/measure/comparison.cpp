#include "comparison.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "label_names.h"
#include "status.h"

namespace tetstream {

// Shares of the memory: the original's cells, the simplified ones, each boundary, while they are
// read; ordering has a quarter for itself, the front the rest.
constexpr size_t kOriginalShare = 3, kSimplifiedShare = 1, kShares = 8, kBoundaryParts = 32;
// Shares of the time after reading.
constexpr double kFieldsEnd = 0.85, kOutsideEnd = 0.92, kCutPixels = 1.6e6;

double FieldComparison::cmse() const {
  return mean_square * unit * unit;
}

double FieldComparison::rms() const {
  return std::sqrt(mean_square) * unit;
}

double FieldComparison::rmsInside() const {
  return std::sqrt(mean_square_inside) * unit;
}

double FieldComparison::cpsnr() const {
  if (mean_square == 0) return std::numeric_limits<double>::infinity();
  if (range == 0) return std::numeric_limits<double>::quiet_NaN();
  return 20 * std::log10(range / rms());
}

double FieldComparison::percent(double error) const {
  return 100 * error / (range > 0 ? range : 1);
}

// ------------------------------------------------------------------------- what is in both

static bool isWanted(const ComparePlan& plan, const std::string& name) {
  if (plan.fields.empty()) return true;
  for (const auto& [field, weight] : plan.fields)
    if (field == name) return weight > 0;
  return false;
}

void Comparison::matchFields(const Schema& original, const Schema& simplified, ScanPlan plans[2]) {
  for (const auto& [name, weight] : plan_.fields)
    for (const Schema* schema : {&original, &simplified})
      if (findColumn(schema->fields, name) < 0)
        fail(Status::kBadArgument, "there is no field \"%s\" in the %s", name.c_str(),
             schema == &original ? "original" : "simplified mesh");
  for (size_t i = 0; i < original.fields.size(); ++i) {
    const Column& column = original.fields[i];
    const int other = findColumn(simplified.fields, column.name);
    if (other < 0 || !isWanted(plan_, column.name)) continue;
    const int components = simplified.fields[static_cast<size_t>(other)].components;
    if (components != column.components && plan_.fields.empty()) continue;
    if (components != column.components)
      fail(Status::kBadArgument, "field \"%s\" has %d components in the original, %d after",
           column.name.c_str(), column.components, components);
    FieldComparison field;
    field.name = column.name;
    field.first = values_;
    field.components = static_cast<size_t>(components);
    values_ += field.components;
    fields_.push_back(std::move(field));
    plans[0].fields.push_back(i);
    plans[1].fields.push_back(static_cast<size_t>(other));
  }
}

void Comparison::findLeftOut() {
  if (!plan_.fields.empty()) return;
  for (int i = 0; i < 2; ++i)
    for (const Column& column : schemas_[i].fields) {
      const std::vector<Column>& others = schemas_[1 - i].fields;
      const int other = findColumn(others, column.name);
      if (other >= 0 && others[static_cast<size_t>(other)].components == column.components)
        continue;
      if (!only_[i].empty()) only_[i] += '\n';
      only_[i] += column.name;
    }
}

// Arrays of one component, of integers or wished for; of "auto" all that both have are followed,
// and the first one that labels regions is told.
void Comparison::matchRegions(const Schema& original, const Schema& simplified, ScanPlan plans[2]) {
  const std::string& wish = plan_.regions;
  if (wish == "none") return;
  const auto labels = [&wish](const Schema& schema, const std::string& name) {
    const int at = findColumn(schema.cell_data, name);
    if (at < 0) return -1;
    const Column& column = schema.cell_data[static_cast<size_t>(at)];
    return (wish == "auto" && isFloat(column.type)) || column.components != 1 ? -1 : at;
  };
  for (const Column& column : original.cell_data) {
    if (wish == "auto" ? namesPartition(column.name) : column.name != wish) continue;
    const int ours = labels(original, column.name), theirs = labels(simplified, column.name);
    if (ours >= 0 && theirs < 0) region_words_ = "the simplified mesh has no " + column.name;
    if (ours < 0 || theirs < 0) continue;
    region_arrays_.push_back(column.name);
    plans[0].cell_arrays.push_back(static_cast<size_t>(ours));
    plans[1].cell_arrays.push_back(static_cast<size_t>(theirs));
  }
  if (wish != "auto" && region_arrays_.empty())
    fail(Status::kBadArgument, "\"%s\" is no cell array of both meshes with one component",
         wish.c_str());
}

Comparison::Comparison(const Schema& original, const Schema& simplified, const ComparePlan& plan)
    : plan_(plan),
      part_(partBoxOf(plan.options.box)),
      memory_(plan.memory_bytes > 0 ? plan.memory_bytes : kDefaultCompareMemory),
      account_(memory_, 0.75),
      schemas_{original, simplified} {
  if (plan.options.cut != "none") checkCut(plan.options.cut);
  ScanPlan plans[2];
  plans[0].mesh = "the original";
  plans[1].mesh = "the simplified mesh";
  matchFields(original, simplified, plans);
  findLeftOut();
  matchRegions(original, simplified, plans);
  plans[0].are_finite = plans[1].are_finite = !plan.fields.empty();  // those that were named
  plans[0].drops_ids = plan.regions == "auto";
  plans[0].part = plans[1].part = part_;
  const auto scan = [&](int which, size_t share) {
    const MeshScan::Budgets budgets = {{account_, plan.temp_dir, memory_ / kShares * share},
                                       {account_, plan.temp_dir, memory_ / kBoundaryParts}};
    return std::make_unique<MeshScan>(schemas_[which], plans[which], budgets, account_);
  };
  original_ = scan(0, kOriginalShare);
  simplified_ = scan(1, kSimplifiedShare);
}

void Comparison::readOriginal(Source& source, const Done& done) {
  original_->read(source, done);
  checkPart();
}

// Of no part there is nothing to be told.
void Comparison::checkPart() {
  if (isWhole() || original_->cells().count() > 0) return;
  const Box& all = original_->box();
  fail(Status::kBadArgument,
       "the original has no cell in the box %s: it lies in %.6g:%.6g,%.6g:%.6g,%.6g:%.6g",
       plan_.options.box.c_str(), all.low[0], all.high[0], all.low[1], all.high[1], all.low[2],
       all.high[2]);
}

// All of it that may have something in common with the original's part.
void Comparison::readSimplified(Source& source, const Done& done) {
  if (!isWhole()) simplified_->keepWhatMeets(original_->cells().box());
  for (size_t i = 0; i < region_arrays_.size(); ++i) {
    if (!original_->regions(i).dropped()) continue;
    simplified_->regions(i).drop();
    region_words_ = region_arrays_[i] + ": nearly all different, taken as ids";
  }
  simplified_->read(source, done);
}

// ---------------------------------------------------------------------------------- measuring

// By the original's labels, then those that only the simplified mesh has.
template <class Pair, class Figures>
static std::vector<Pair> pairByLabel(const std::map<int64_t, Figures>& ours,
                                     const std::map<int64_t, Figures>& theirs) {
  std::vector<Pair> pairs;
  for (const auto& [label, figures] : ours) {
    const auto found = theirs.find(label);
    pairs.push_back({label, figures, found == theirs.end() ? Figures() : found->second, ""});
  }
  for (const auto& [label, figures] : theirs)
    if (!ours.count(label)) pairs.push_back({label, Figures(), figures, ""});
  return pairs;
}

// As the original has it, or else the simplified mesh.
template <class Pair>
void Comparison::nameLabels(std::vector<Pair>& pairs, const std::string& array) const {
  for (Pair& pair : pairs)
    for (const Schema& schema : schemas_)
      if (const LabelName* found = findLabelName(schema.label_names, array, pair.label);
          found && pair.name.empty())
        pair.name = found->name;
}

// Where squares of areas, of faces a thousandth of the whole, are no numbers of float64 any more.
void Comparison::checkExtent() const {
  constexpr double kLeast = 1e-70, kMost = 1e70;
  double extent = 0, farthest = 0;
  for (int k = 0; k < 3; ++k) {
    extent = std::max(extent, box_.high[k] - box_.low[k]);
    farthest = std::max({farthest, std::fabs(box_.low[k]), std::fabs(box_.high[k])});
  }
  if ((extent > 0 && extent < kLeast) || farthest > kMost)
    fail(Status::kUnsupported,
         "the original is %.3g across, with coordinates up to %.3g: areas and volumes are numbers "
         "of "
         "float64 from %g to %g only; scale both meshes",
         extent, farthest, kLeast, kMost);
}

double Comparison::diagonal() const {
  double square = 0;
  for (int k = 0; k < 3; ++k) square += (box_.high[k] - box_.low[k]) * (box_.high[k] - box_.low[k]);
  return std::isfinite(square) ? std::sqrt(square) : 0;
}

bool Comparison::topologyKept() const {
  const TopologyFigures &a = figures_[0].topology, &b = figures_[1].topology;
  return a.euler() == b.euler() && a.boundaryEuler() == b.boundaryEuler() &&
         a.components == b.components && a.boundary_components == b.boundary_components &&
         a.nonmanifold_faces == b.nonmanifold_faces && a.nonmanifold_edges == b.nonmanifold_edges &&
         a.nonmanifold_vertices == b.nonmanifold_vertices;
}

void Comparison::measure(const Tasks* tasks, const Done& done) {
  MeshScan* scans[2] = {original_.get(), simplified_.get()};
  for (int i = 0; i < 2; ++i) {
    figures_[i].topology = scans[i]->topology();
    figures_[i].shapes = scans[i]->shapes();
    figures_[i].boundary_area = scans[i]->boundaryArea();
  }
  box_ = original_->box();
  checkExtent();
  cells_compared_ = original_->cells().count();
  volume_compared_ = original_->volumeKept();
  findRanges();
  compareRegions();
  face_labels_ = pairByLabel<FaceLabelComparison>(original_->faceLabels().labels(),
                                                  simplified_->faceLabels().labels());
  nameLabels(face_labels_, "");
  if (plan_.options.cut != "none") drawCut();
  measureFields(tasks, [&](double share) { done(kOutsideEnd * share); });
  measureDistances(tasks, [&](double share) { done(kOutsideEnd + (1 - kOutsideEnd) * share); });
  original_.reset();
  simplified_.reset();
}

// A power of two whose inverse is a number, too, and near the width, which may be infinite.
static double unitOf(double width) {
  if (std::isinf(width)) return std::ldexp(1, 1022);
  return width > 0 ? std::ldexp(1, std::clamp(std::ilogb(width), -1022, 1022)) : 1;
}

void Comparison::findRanges() {
  constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
  for (size_t f = 0; f < fields_.size(); ++f) {
    FieldComparison& field = fields_[f];
    field.is_finite = original_->isFinite(f) && simplified_->isFinite(f);
    if (field.is_finite)
      findRange(field);
    else
      field.range = field.largest = field.largest_inside = field.mean_square =
          field.mean_square_inside = kNone;
  }
}

const FieldComparison* Comparison::firstField() const {
  const auto first = std::find_if(fields_.begin(), fields_.end(),
                                  [](const FieldComparison& f) { return f.is_finite; });
  return first == fields_.end() ? nullptr : &*first;
}

void Comparison::findRange(FieldComparison& field) const {
  std::vector<double> widths;
  double span = 0;  // of the values of both meshes
  for (size_t c = field.first; c < field.first + field.components; ++c) {
    const double low = original_->lowest()[c], high = original_->highest()[c];
    widths.push_back(std::max(high - low, 0.0));
    span = std::max(
        span, std::max(high, simplified_->highest()[c]) - std::min(low, simplified_->lowest()[c]));
  }
  field.unit = unitOf(span);
  const double of_range = unitOf(*std::max_element(widths.begin(), widths.end()));
  double square = 0;
  for (const double width : widths) square += (width / of_range) * (width / of_range);
  field.range = std::sqrt(square) * of_range;
}

void Comparison::measureFields(const Tasks* tasks, const Done& done) {
  std::vector<ComparedField> compared;
  std::vector<FieldComparison*> found;
  for (FieldComparison& f : fields_) {
    if (!f.is_finite) continue;
    compared.push_back({f.first, f.components, f.range / f.unit, 1 / f.unit});
    found.push_back(&f);
  }
  FieldDifference difference(compared, values_,
                             {plan_.options.samples, plan_.seed, volume_compared_},
                             {account_, plan_.temp_dir, memory_ / 2, tasks});
  constexpr double kShare = kFieldsEnd / kOutsideEnd;
  difference.measure(original_->cells(), simplified_->cells(),
                     [&](double share) { done(kShare * share); });
  difference.measureOutside(simplified_->boundary(),
                            [&](double share) { done(kShare + (1 - kShare) * share); });
  volumes_ = difference.volumes();
  volumes_.outside = std::max(volumes_.outside, 0.0);  // of differences that rounding leaves
  const double volume = volumes_.covered + volumes_.outside;
  for (size_t f = 0; f < found.size(); ++f) {
    const FieldSums &in = difference.inside(f), &out = difference.outside(f);
    FieldComparison& field = *found[f];
    const FieldSums& larger = out.largest > in.largest ? out : in;
    field.largest_inside = in.largest * field.unit;
    field.largest = larger.largest * field.unit;
    std::copy_n(larger.place, 3, field.largest_place);
    field.mean_square = volume > 0 ? (in.squares + out.squares) / volume : 0;
    field.mean_square_inside = volumes_.covered > 0 ? in.squares / volumes_.covered : 0;
    field.histogram.add(in.histogram);
    field.histogram.add(out.histogram);
  }
}

void Comparison::measureDistances(const Tasks* tasks, const Done& done) {
  MeshScan* scans[2] = {original_.get(), simplified_.get()};
  for (int i = 0; i < 2; ++i)
    distances_[i] = boundaryDistance(
        scans[i]->boundary(), scans[1 - i]->boundary(),
        {plan_.options.surfaceSamples(), plan_.seed, scans[i]->boundaryAreaInPart(), part_},
        {account_, plan_.temp_dir, memory_ / 4, tasks},
        [&](double share) { done((i + share) / 2); });
}

void Comparison::compareRegions() {
  std::string array;
  for (size_t i = 0; i < region_arrays_.size(); ++i) {
    const RegionParts& ours = original_->regions(i);
    const RegionParts& theirs = simplified_->regions(i);
    const bool is_wished = plan_.regions != "auto";
    if (ours.dropped() || (!is_wished && ours.regions().size() < 2)) continue;
    array = region_arrays_[i];
    regions_ = pairByLabel<RegionComparison>(ours.regions(), theirs.regions());
    nameLabels(regions_, array);
    break;
  }
  if (!array.empty())
    region_words_ = "by " + array;
  else if (region_words_.empty())
    region_words_ = "none";
}

// Of a plane that was named, which may lie beside the meshes or in a gap between their parts; in
// one of our choice a gap is drawn. Beside the part that is compared the simplified mesh goes on,
// which tells nothing of that part.
void Comparison::checkCutMeets(const CutComparison& cut) const {
  if (plan_.options.cut.find('=') == std::string::npos) return;
  if (cut.original->cellsCut() > 0 || (isWhole() && cut.simplified->cellsCut() > 0)) return;
  const int axis = cut.plane.axis;
  const Box& box = original_->cells().box();
  fail(Status::kBadArgument, "the cut at %c = %.6g meets no cell: the %s lies in %.6g:%.6g",
       "xyz"[axis], cut.plane.at, isWhole() ? "original" : "part of the original", box.low[axis],
       box.high[axis]);
}

// The first field, on a raster that takes an eighth of the memory at most.
void Comparison::drawCut() {
  CutComparison cut;
  cut.plane = cutPlaneOf(plan_.options.cut, original_->cells().box());
  Box seen = cutBoxOf(original_->cells(), cut.plane);
  cut.is_whole = isWhole();
  if (cut.is_whole) seen.add(cutBoxOf(simplified_->cells(), cut.plane));
  showBox(seen, cut.plane);
  CutImage::Shown shown = {0, 0, nullptr};
  if (const FieldComparison* const first = firstField()) {
    const FieldComparison& field = *first;
    cut.field = field.name;
    cut.components = field.components;
    for (size_t c = 0; c < field.components; ++c) {
      const double low = original_->lowest()[field.first + c];
      cut.zero.push_back(field.components == 1 && std::isfinite(low) ? low : 0);
    }
    shown = {field.first, field.components, cut.zero.data()};
  }
  const double wide = cut.plane.high[0] - cut.plane.low[0];
  const double tall = cut.plane.high[1] - cut.plane.low[1];
  if (!(wide > 0 && tall > 0)) return;
  const double bytes = 2.0 * (4 + 4 * static_cast<double>(shown.components));
  const double pixels = std::min(kCutPixels, static_cast<double>(memory_) / 8 / bytes);
  const double ratio = std::clamp(wide / tall, 0.05, 20.0);
  const auto width = static_cast<size_t>(std::max(std::sqrt(pixels * ratio), 1.0));
  const auto height = static_cast<size_t>(std::max(std::sqrt(pixels / ratio), 1.0));
  const auto draw = [&](MeshScan& scan) {
    auto image = std::make_unique<CutImage>(account_, cut.plane, width, height, shown);
    image->add(scan.cells());
    return image;
  };
  cut.original = draw(*original_);
  cut.simplified = draw(*simplified_);
  checkCutMeets(cut);
  cut_ = std::move(cut);
}

}  // namespace tetstream
