#include "spectral.h"
#include "fiedler.h"
#include "vertex_graph.h"
#include "order_front.h"
#include <algorithm>
#include <numeric>
#include <ctime>
#include <cstdio>
namespace tetstream {
namespace {
double now() { timespec t; clock_gettime(CLOCK_PROCESS_CPUTIME_ID,&t); return t.tv_sec+1e-9*t.tv_nsec; }
}
void orderSpectral(const Connectivity& mesh, Account& account,
                   const std::function<void()>& tell, Array<uint32_t>& rank) {
  double t0=now();
  VertexGraph graph(account);
  { CellLists lists(account); listCells(mesh, lists); buildGraph(mesh, lists, account, graph); }
  double t1=now();
  Array<uint32_t> member(account), start(account);
  uint32_t count = findComponents(graph, account, member, start);
  // renumber
  Array<uint32_t> number(account, mesh.vertices), first(account, mesh.vertices+1), neighbour(account, graph.neighbour.size());
  for (uint32_t c=0;c<count;++c) for (uint32_t i=start[c];i<start[c+1];++i) number[member[i]]=i-start[c];
  uint32_t end=0;
  for (uint32_t i=0;i<mesh.vertices;++i){ first[i]=end; for(const uint32_t*u=graph.begin(member[i]);u<graph.end(member[i]);++u) neighbour[end++]=number[*u]; }
  first[mesh.vertices]=end;
  double t2=now();
  fprintf(stderr,"graph %.2f renumber %.2f components %u\n",t1-t0,t2-t1,count);
  for (uint32_t c=0;c<count;++c){
    GraphView view{start[c+1]-start[c], first.data()+start[c], neighbour.data(), nullptr};
    if (view.vertices<2) { rank[member[start[c]]]=start[c]; continue; }
    double t3=now();
    Array<Four> x(account);
    auto values=lowestVectors(view, account, tell, x);
    double t4=now();
    if (view.vertices>1000) fprintf(stderr,"component of %u: %.2f s values %g %g %g %g\n",view.vertices,t4-t3,values[0],values[1],values[2],values[3]);
    std::vector<uint32_t> order(view.vertices); std::iota(order.begin(),order.end(),0u);
    std::stable_sort(order.begin(),order.end(),[&](uint32_t a,uint32_t b){return x[a][0]<x[b][0];});
    for(uint32_t i=0;i<view.vertices;++i) rank[member[start[c]+order[i]]]=start[c]+i;
  }
}
}
