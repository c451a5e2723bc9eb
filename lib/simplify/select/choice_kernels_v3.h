// simplify/select: the choice kernels' build for x86-64-v3 processors. Internal to the room.
#pragma once

#include "choice_kernels.h"

namespace tetstream::v3 {

void relistEdges(const ChoiceTable&, uint32_t, const EdgeList<float>&);
void relistEdges(const ChoiceTable&, uint32_t, const EdgeList<double>&);
void addEdges(const ChoiceTable&, uint32_t, const EdgeList<float>&);
void addEdges(const ChoiceTable&, uint32_t, const EdgeList<double>&);
void replaceEdges(const ChoiceTable&, uint32_t, uint32_t, const EdgeList<float>&);
void replaceEdges(const ChoiceTable&, uint32_t, uint32_t, const EdgeList<double>&);
void refuseEdge(const ChoiceTable&, uint32_t, uint32_t);
void reconsiderEdges(const ChoiceTable&, uint32_t);

}  // namespace tetstream::v3
