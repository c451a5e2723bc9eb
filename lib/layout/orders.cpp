#include "orders.h"

#include "status.h"

namespace tetstream {

struct NamedOrder {
  const char* name;
  Order order;
};
constexpr NamedOrder kOrders[] = {
    {"auto", Order::kAuto},
    {"none", Order::kNone},
    {"spatial", Order::kSpatial},
    {"brick", Order::kBrick},
    {"z-order", Order::kZOrder},
    {"hilbert", Order::kHilbert},
    {"breadth-first", Order::kBreadthFirst},
    {"spectral", Order::kSpectral},
};

Order orderOf(const std::string& name) {
  std::string all;
  for (const NamedOrder& row : kOrders) {
    if (name == row.name) return row.order;
    all += (all.empty() ? "" : ", ") + std::string(row.name);
  }
  fail(Status::kBadArgument, "order \"%s\": there are %s", name.c_str(), all.c_str());
}

const char* nameOf(Order order) {
  for (const NamedOrder& row : kOrders)
    if (row.order == order) return row.name;
  return "";
}

}  // namespace tetstream
