#include "balance.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "status.h"

namespace tetstream {
namespace {

constexpr double kLeastBalance = 1.0 / 128;
// Beside interfaces that are rough, which follow nothing, twice as much: bodies of grains lost
// corners.
constexpr double kBesideRough = 0.5;
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

  struct Logs {
    double field, sheet;  // of squared errors
    double product() const { return field + sheet; }
  };

  // Of the sheet `of`, which is one of the groups.
  Logs foretell(const Balance& balance, double ratio, const RemovalCosts::Group& of) {
    inside_ = items(costs_.inside, 0);
    outer_ = items(costs_.outer, balance.outer);
    interfaces_ = items(costs_.interfaces, balance.outer * balance.interfaces);
    const double log_cost = commonCost(ratio);
    const double field = costs_.least_field + errorOf(inside_, kInsideLaw, log_cost, &Item::field) +
                         errorOf(outer_, kSheetLaw, log_cost, &Item::field) +
                         errorOf(interfaces_, kSheetLaw, log_cost, &Item::field);
    const std::vector<Item>& sheet = &of == &costs_.outer ? outer_ : interfaces_;
    return {std::log(field), std::log(errorOf(sheet, kSheetLaw, log_cost, &Item::sheet))};
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

// What lowering a weight asks for: so much of a gain for each step, and of the errors of the sheet
// that they are at least this part of the fields' before it, and no more than that after it.
struct Terms {
  double worth, least_share = kNegligible, most = std::numeric_limits<double>::infinity();
};

// Halves the weight as often as is worth it most. All are tried: of what is far too heavy nothing
// moves at first.
static void lower(Model& model, double ratio, const Terms& terms, const RemovalCosts::Group& sheet,
                  double Balance::*weight, Balance* balance) {
  const Model::Logs now = model.foretell(*balance, ratio, sheet);
  if (!std::isfinite(now.product()) || now.sheet < now.field + std::log(terms.least_share)) return;
  double least = now.product(), asked = 0;
  Balance next = *balance;
  // Interfaces fall with the boundary: those that are rough may fall as far as they like.
  const double interfaces = balance->rough_interfaces ? kBesideRough : balance->interfaces;
  const double besides = weight == &Balance::outer ? interfaces : balance->outer;
  while (besides * next.*weight > kLeastBalance) {
    next.*weight /= 2;
    asked += terms.worth;
    const Model::Logs then = model.foretell(next, ratio, sheet);
    const double product = then.product() + asked;
    if (!(product < least) || then.sheet > std::log(terms.most)) continue;
    least = product;
    balance->*weight = next.*weight;
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
static void lowerInWalls(Model& model, double ratio, const RemovalCosts::Group& sheet,
                         Balance* balance) {
  const Model::Logs now = model.foretell(*balance, ratio, sheet);
  const double most = now.field + std::log(kDrowned);
  while (balance->outer > kLeastBalance && now.sheet + std::log(balance->outer) > most)
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

// Of interfaces that are rough: a fortieth of what the boundary counts. From 1/512 to 1/32768 the
// errors of fields at 0.1 are alike within a quarter; distances are a tenth of the edges left.
constexpr double kRoughBalance = 1.0 / 2048;
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
  return model.foretell(balance, ratio, costs.outer).field >
         std::log(kNoErrors * costs.least_field);
}

void chooseBalance(const RemovalCosts& costs, double ratio, Balance* balance) {
  if (!balance->knows_interfaces && areRough(costs)) {
    balance->interfaces = kRoughBalance;
    balance->knows_interfaces = balance->rough_interfaces = true;
  }
  const bool is_wall = isWall(costs);
  if (!is_wall && costs.inside.vertices < kLeastVertices) return;
  Model model(costs);
  const double worth = costs.is_whole ? kWorth : kWorthInStream;
  if (!balance->knows_outer && isEnough(costs.outer) && hasFields(model, costs, ratio, *balance)) {
    if (costs.touching < kTouching) {
      if (is_wall) lowerInWalls(model, ratio, costs.outer, balance);
      const Terms terms = is_wall ? Terms{worth, kOfTheField, mostInGaps(costs)} : Terms{worth};
      lower(model, ratio, terms, costs.outer, &Balance::outer, balance);
    }
    balance->knows_outer = true;
  }
  if (costs.inside.vertices < kLeastVertices) return;
  if (!balance->knows_interfaces && isEnough(costs.interfaces)) {
    lower(model, ratio, {worth}, costs.interfaces, &Balance::interfaces, balance);
    balance->knows_interfaces = true;
  }
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
