#include "balance.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "status.h"

namespace tetstream {
namespace {

constexpr double kLeastBalance = 1.0 / 128, kLeastInterfaces = 1.0 / 1024;
// Beside interfaces that follow little, twice as much: bodies of grains and blocks lost corners.
constexpr double kBesideFree = 0.5;
// A step halves a weight. The logarithm of the product of both squared errors has to fall by so
// much for it, or noise would take it; where more of the stream is to come, by more.
constexpr double kWorth = 0.03, kWorthInStream = 0.1;
// A sheet that adds less than this share of the fields' error, as a plane one does, or one of which
// all is kept, is left alone.
constexpr double kNegligible = 1e-3;
// Edges do not become longer than so many times their length, nor what costs nothing free: of the
// mean cost.
constexpr double kLongest = 12, kLeastCost = 1e-6;
constexpr int kSteps = 16;  // of the search for t

struct Law {
  double cost_power, density_power;
};
constexpr Law kInsideLaw = {7, 3}, kSheetLaw = {6, 2};

struct Item {
  double log_cost, field, sheet, count;
};

class Model {
 public:
  explicit Model(const RemovalCosts& costs) : costs_(costs) {}

  struct Errors {
    double field, outer, interfaces;  // squared
  };

  Errors foretell(const Balance& balance, double ratio) {
    inside_ = items(costs_.inside, 0);
    outer_ = items(costs_.outer, balance.outer);
    interfaces_ = items(costs_.interfaces, balance.outer * balance.interfaces);
    const double log_cost = commonCost(ratio);
    Errors errors;
    errors.field = costs_.least_field + errorOf(inside_, kInsideLaw, log_cost, &Item::field) +
                   errorOf(outer_, kSheetLaw, log_cost, &Item::field) +
                   errorOf(interfaces_, kSheetLaw, log_cost, &Item::field);
    errors.outer = errorOf(outer_, kSheetLaw, log_cost, &Item::sheet);
    errors.interfaces = errorOf(interfaces_, kSheetLaw, log_cost, &Item::sheet) / kInterfaceShare;
    return errors;
  }

 private:
  static double costOf(const Removal& removal, double weight) {
    return removal.field + weight * removal.sheet;
  }

  // The mean of the cheaper third of the ways: the cheapest alone would be too cheap.
  Removal expected(const Ways& ways, double weight) {
    if (ways.empty()) return {0, 0};
    ways_ = ways;
    const size_t third = ways_.size() / 3;
    std::nth_element(ways_.begin(), ways_.begin() + static_cast<std::ptrdiff_t>(third), ways_.end(),
                     [weight](const Removal& a, const Removal& b) {
                       return costOf(a, weight) < costOf(b, weight);
                     });
    Removal mean = {0, 0};
    for (size_t i = 0; i <= third; ++i) {
      mean.field += ways_[i].field / static_cast<double>(third + 1);
      mean.sheet += ways_[i].sheet / static_cast<double>(third + 1);
    }
    return mean;
  }

  std::vector<Item> items(const RemovalCosts::Group& group, double weight) {
    std::vector<Removal> removals;
    double sum = 0;
    for (const Ways& ways : group.sample) {
      removals.push_back(expected(ways, weight));
      sum += costOf(removals.back(), weight);
    }
    const auto size = static_cast<double>(removals.size());
    const double least = kLeastCost * sum / size;
    std::vector<Item> all;
    for (const Removal& r : removals) {
      const double cost = std::max(costOf(r, weight), least);
      if (cost > 0) all.push_back({std::log(cost), r.field, r.sheet, group.vertices / size});
    }
    return all;
  }

  static double logLength(const Item& item, const Law& law, double log_cost) {
    static const double longest = std::log(kLongest);
    return std::clamp((log_cost - item.log_cost) / law.cost_power, 0.0, longest);
  }

  static double left(const std::vector<Item>& items, const Law& law, double log_cost) {
    double sum = 0;
    for (const Item& item : items)
      sum += item.count * std::exp(-law.density_power * logLength(item, law, log_cost));
    return sum;
  }
  double left(double log_cost) const {
    return left(inside_, kInsideLaw, log_cost) + left(outer_, kSheetLaw, log_cost) +
           left(interfaces_, kSheetLaw, log_cost);
  }

  double commonCost(double ratio) const {
    double low = 1e300, high = -1e300, all = 0;
    for (const auto* group : {&inside_, &outer_, &interfaces_})
      for (const Item& item : *group) {
        low = std::min(low, item.log_cost);
        high = std::max(high, item.log_cost);
        all += item.count;
      }
    high += kInsideLaw.cost_power * std::log(kLongest);
    for (int k = 0; k < kSteps; ++k) {
      const double middle = (low + high) / 2;
      (left(middle) > ratio * all ? low : high) = middle;
    }
    return high;
  }

  static double errorOf(const std::vector<Item>& items, const Law& law, double log_cost,
                        double Item::*part) {
    double sum = 0;
    for (const Item& item : items) {
      const double length = logLength(item, law, log_cost);
      const double power = (part == &Item::field ? kInsideLaw : kSheetLaw).cost_power;
      const double left = item.count * std::exp(-law.density_power * length);
      sum += left * item.*part * std::expm1(power * length);
    }
    return sum;
  }

  const RemovalCosts& costs_;
  std::vector<Item> inside_, outer_, interfaces_;
  Ways ways_;
};

}  // namespace

constexpr size_t kLeastSamples = 32;
// Of a body's boundary: less is no contact.
constexpr double kTouching = 1.0 / 16;

static bool isEnough(const RemovalCosts::Group& sheet) {
  return sheet.vertices >= kLeastVertices && sheet.sample.size() >= kLeastSamples;
}

// What lowering weights asks for: so much of a gain for each step, and of the error of a sheet that
// it is at least this part of the fields' before it, and no more than that after it.
struct Terms {
  double worth, least_share = kNegligible, most = std::numeric_limits<double>::infinity();
};

// Which weights are to be chosen.
struct Sheets {
  bool outer, interfaces;
};

// Interfaces fall with the boundary: those that may fall further by themselves are no limit.
static bool canLowerOuter(const Balance& balance, bool with_interfaces) {
  const bool are_free = with_interfaces || balance.rough_interfaces;
  return (are_free ? kBesideFree : balance.interfaces) * balance.outer > kLeastBalance;
}

// However little the boundary counts, interfaces need not count more; nor do they count less then.
static bool canLowerInterfaces(const Balance& balance) {
  return balance.outer * balance.interfaces > kLeastInterfaces ||
         kInterfaceShare * balance.interfaces > 2;
}

// Halves weights as often as is worth it most. All are tried: of what is far too heavy nothing
// moves at first, and where a boundary bends beside interfaces that do so, too, each drives up the
// other's error: of a head with three shells both came out twice as far off, and so did the field,
// where the boundary's weight alone was lowered first.
static void lower(Model& model, double ratio, const Terms& terms, Sheets sheets, Balance* balance) {
  const Model::Errors now = model.foretell(*balance, ratio);
  const auto counts = [&](double error) {
    return std::isfinite(error) && error >= now.field * terms.least_share;
  };
  sheets.outer &= counts(now.outer);
  sheets.interfaces &= counts(now.interfaces);
  // The fields' error counts once for each sheet, but three times for interfaces alone: they still
  // lie off by no more than a fiftieth of the edges that are left.
  const auto product = [&](const Model::Errors& errors) {
    const double times = !sheets.interfaces ? 1 : sheets.outer ? 2 : 3;
    return times * std::log(errors.field) + std::log((sheets.outer ? errors.outer : 0) +
                                                     (sheets.interfaces ? errors.interfaces : 0));
  };
  double least = product(now);
  if (!std::isfinite(least)) return;
  double asked_outer = 0;
  for (Balance outer = *balance;; outer.outer /= 2, asked_outer += terms.worth) {
    double asked = asked_outer;
    for (Balance next = outer;; next.interfaces /= 2, asked += terms.worth) {
      const Model::Errors then = model.foretell(next, ratio);
      if (product(then) + asked < least && !(then.outer > terms.most)) {
        least = product(then) + asked;
        *balance = next;
      }
      if (!sheets.interfaces || !canLowerInterfaces(next)) break;
    }
    if (!sheets.outer || !canLowerOuter(outer, sheets.interfaces)) break;
  }
}

// In walls of one cell vertices lie on the boundary, all but one in so many. Where what it adds, as
// squared errors, is so many times the field's, the field decides nothing, not even which edges
// become long: a tube of 130,539 cells had four times the error of the field at 0.1, for as large a
// distance.
constexpr double kOfWalls = 16, kDrowned = 64;
// Where the boundary adds less than the field, as plane sides do, that gained nothing by its going
// up to fifty times as far.
constexpr double kOfTheField = 1;

// Halves the weight until the field is heard.
static void lowerInWalls(Model& model, double ratio, Balance* balance) {
  const Model::Errors now = model.foretell(*balance, ratio);
  while (balance->outer > kLeastBalance && now.outer * balance->outer > now.field * kDrowned)
    balance->outer /= 2;
}

// Distances are foretold by ways to neighbours: what comes out, at the best places, is a tenth to a
// twentieth as far off. At 2.5 times their gaps the layers of a rolled sheet went through each
// other, at 1.9 they did not; voxels have 5 and more.
constexpr double kOfGap = 1.5;
constexpr double kNarrow = 0.1;  // of the boundary, as narrow as this

// The error of a sheet that fills its gaps so far; nothing where none is known.
static double mostInGaps(const RemovalCosts& costs) {
  std::vector<double> gaps = costs.gaps;
  if (gaps.empty()) return 0;
  const auto narrow =
      gaps.begin() + static_cast<std::ptrdiff_t>(kNarrow * static_cast<double>(gaps.size()));
  std::nth_element(gaps.begin(), narrow, gaps.end());
  return kOfGap * kOfGap * *narrow * costs.outer.vertices;
}

bool isWall(const RemovalCosts& costs) {
  return costs.is_whole && kOfWalls * costs.inside.vertices < costs.outer.vertices;
}

// Of interfaces that are rough; and where enough vertices lie inside regions, for each on them, to
// gain by it: fields at 0.1 would have up to half as much error again. (At 1/524288 another fifth
// less, but more of the volume comes to lie in other regions: of labels of cell centres 2.4 % in
// place of 2.) Grains of 80 cells only came closer to targets that are out of reach.
constexpr double kRoughBalance = 1.0 / 2048, kRoughInBulk = 1.0 / 32768, kBulk = 0.75;
// Of the pairs of what is rough, and of the squares: of plane sides with many rims beside them, as
// of thin plates, fewer lie off, to either side.
constexpr double kMostOff = 0.75, kLeastAgainst = 0.05;

// Half as many pairs tell, where all are off and to either side by more than so much.
constexpr double kSurelyAgainst = 0.25;

static bool isEnough(const RemovalCosts::Jitter& jitter) {
  const bool tells = jitter.off == jitter.pairs && jitter.product < -kSurelyAgainst * jitter.square;
  return jitter.pairs >= (tells ? kLeastPairs / 2 : kLeastPairs);
}

// What bends lies off its neighbours' mean to the same side as its neighbours do of theirs; of what
// is off by chance they lie on the other side. Fields without errors would gain nothing.
static bool areRough(const RemovalCosts& costs) {
  const RemovalCosts::Jitter& jitter = costs.jitter;
  const bool are_off =
      static_cast<double>(jitter.off) >= kMostOff * static_cast<double>(jitter.pairs);
  if (!isEnough(jitter) || !are_off) return false;
  if (!(jitter.product < -kLeastAgainst * jitter.square)) return false;
  double field = 0;
  for (const Ways& ways : costs.interfaces.sample)
    for (const Removal& r : ways) field += r.field / static_cast<double>(ways.size());
  const auto sampled = static_cast<double>(costs.interfaces.sample.size());
  return field * costs.interfaces.vertices > costs.least_field * sampled;
}

// A stream may begin far from where its fields change: as long as their errors count as none
// nothing is told of what the boundary would leave them.
constexpr double kNoErrors = 2;  // as `least_field`, which is in what is foretold

static bool hasFields(Model& model, const RemovalCosts& costs, double ratio,
                      const Balance& balance) {
  if (costs.is_whole || !(costs.least_field > 0)) return true;
  return model.foretell(balance, ratio).field > kNoErrors * costs.least_field;
}

// What leaving costs a vertex that is neither on a straight crease nor on a plane side: this part
// of what it costs all, at least.
constexpr double kCorner = 0.01;

static double meanSheet(const std::vector<Ways>& sample) {
  double sum = 0;
  for (const Ways& ways : sample)
    for (const Removal& r : ways) sum += r.sheet / static_cast<double>(ways.size());
  return sum / static_cast<double>(sample.size());
}

// How many vertices of a sheet lie where it bends, but for straight creases.
static double corners(const RemovalCosts::Group& sheet) {
  const double least = kCorner * meanSheet(sheet.sample);
  const auto met = std::count_if(sheet.along_creases.begin(), sheet.along_creases.end(),
                                 [&](const Ways& ways) { return meanSheet({ways}) > least; });
  return sheet.vertices * static_cast<double>(met) / static_cast<double>(sheet.sample.size());
}

// Leaving a straight crease is so dear that on bodies with plane sides it would count for nearly
// all: of a lattice's struts of 4 cells the boundary came out 1.2 % of the diagonal off at 0.05,
// for 1 % less error. Where not even all corners can be left, creases are left, too.
static RemovalCosts alongCreases(const RemovalCosts& costs, double ratio) {
  RemovalCosts along = costs;
  const double all = costs.inside.vertices + costs.outer.vertices + costs.interfaces.vertices;
  for (auto* sheet : {&along.outer, &along.interfaces})
    if (!sheet->along_creases.empty() && corners(*sheet) < ratio * all)
      sheet->sample.swap(sheet->along_creases);
  return along;
}

void chooseBalance(const RemovalCosts& all, double ratio, Balance* balance) {
  if (!balance->knows_interfaces && areRough(all)) {
    const bool is_bulk = all.inside.vertices > kBulk * all.interfaces.vertices;
    balance->interfaces = is_bulk ? kRoughInBulk : kRoughBalance;
    balance->knows_interfaces = balance->rough_interfaces = true;
  }
  const bool is_wall = isWall(all);
  const bool has_inside = all.inside.vertices >= kLeastVertices;
  if (!is_wall && !has_inside) return;
  const RemovalCosts costs = alongCreases(all, ratio);
  Model model(costs);
  const double worth = costs.is_whole ? kWorth : kWorthInStream;
  Sheets sheets;
  sheets.outer =
      !balance->knows_outer && isEnough(costs.outer) && hasFields(model, costs, ratio, *balance);
  balance->knows_outer |= sheets.outer;
  sheets.outer &= costs.touching < kTouching;
  sheets.interfaces = has_inside && !balance->knows_interfaces && isEnough(costs.interfaces);
  balance->knows_interfaces |= sheets.interfaces;
  if (is_wall && sheets.outer) {
    lowerInWalls(model, ratio, balance);
    lower(model, ratio, {worth, kOfTheField, mostInGaps(costs)}, {true, false}, balance);
    sheets.outer = false;
  }
  lower(model, ratio, {worth}, sheets, balance);
}

double usualCost(double* costs, size_t count) {
  double* const third = costs + count / 3;
  for (size_t i = 0; i < count; ++i)
    if (!std::isfinite(costs[i])) costs[i] = 0;
  std::nth_element(costs, third, costs + count);
  return *third > 0 ? *third : 0;
}

static std::string sheetsInWords(const Balance& b, bool has_interfaces) {
  const double interfaces = has_interfaces ? b.outer * b.interfaces : 1;
  std::string text;
  if (b.outer < 1) text = textOf("the boundary counts 1/%.0f of its weight", 1 / b.outer);
  if (interfaces < 1)
    text += textOf(b.outer < 1 ? ", interfaces 1/%.0f" : "interfaces count 1/%.0f of their weight",
                   1 / interfaces);
  if (interfaces < 1 && b.rough_interfaces) text += ", being rough from vertex to vertex";
  return text.empty() ? text : text + ": more would leave the fields too little";
}

// The first that count for more, and how many others do.
static std::string fieldsInWords(const Balance& balance, const std::vector<Column>& fields) {
  constexpr size_t kNamed = 6;
  std::string text;
  size_t heavier = 0;
  for (size_t f = 0; f < balance.fields.size(); ++f) {
    if (!(balance.fields[f] > 1) || heavier++ >= kNamed) continue;
    text += textOf("%s%s %.0f times", heavier == 1 ? "smoother fields count for more: " : ", ",
                   fields[f].name.c_str(), balance.fields[f]);
  }
  if (heavier <= kNamed) return text;
  return text + textOf(" and %zu other%s", heavier - kNamed, heavier == kNamed + 1 ? "" : "s");
}

// The names of those that do not count at all.
static std::string variationInWords(const Balance& balance, Variation variation, const char* what,
                                    const std::vector<Column>& fields) {
  std::string names;
  for (size_t f = 0; f < balance.varies.size(); ++f)
    if (balance.varies[f] == variation) names += (names.empty() ? what : ", ") + fields[f].name;
  return names;
}

std::string inWords(const Balance& balance, bool has_interfaces,
                    const std::vector<Column>& fields) {
  std::string text;
  for (const std::string& part :
       {sheetsInWords(balance, has_interfaces), fieldsInWords(balance, fields),
        variationInWords(balance, Variation::kConstant, "constant: ", fields),
        variationInWords(balance, Variation::kByRounding, "constant but for rounding: ", fields),
        variationInWords(balance, Variation::kOutOfReach,
                         "of too large or too small a range to be followed: ", fields)})
    if (!part.empty()) text += (text.empty() ? "" : "; ") + part;
  return text;
}

}  // namespace tetstream
