#pragma once
#include <functional>
#include "connectivity.h"
namespace tetstream {
void orderSpectral(const Connectivity& mesh, Account& account,
                   const std::function<void()>& tell, Array<uint32_t>& rank);
}
