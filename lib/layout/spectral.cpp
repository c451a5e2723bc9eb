#include "spectral.h"
#include "fiedler.h"
#include "front_growth.h"
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

    const uint32_t n=view.vertices;
    std::vector<uint32_t> order(n), best(n), seq(n), when(n); 
    std::vector<float> guide(n), g(n);
    FrontGrowth growth(view, account);
    uint32_t widest_best=~0u;
    auto layers=[&](const std::vector<uint32_t>& sequence){
      // width at each step, then guide = sum of 1/width
      std::vector<uint8_t> opened(n); uint32_t active=0, widest=0; double at=0;
      for(uint32_t v: sequence){ if(!opened[v]){opened[v]=1;++active;}
        for(uint32_t i=view.first[v];i<view.first[v+1];++i) if(!opened[view.neighbour[i]]){opened[view.neighbour[i]]=1;++active;}
        widest=std::max(widest,active); at+=1.0/active; g[v]=at; --active; }
      return widest; };
    int nv = getenv("NV")?atoi(getenv("NV")):1;
    for (int k=0;k<nv;++k) for(int sign=-1;sign<=1;sign+=2){
      std::iota(order.begin(),order.end(),0u);
      std::stable_sort(order.begin(),order.end(),[&](uint32_t a,uint32_t b){return sign*x[a][k]<sign*x[b][k];});
      uint32_t plain=layers(order);
      if(n>1000) fprintf(stderr," vector %d sign %d plain %u:",k,sign,plain);
      if (plain<widest_best){widest_best=plain;best=order;}
      for(float pull: {0.5f,1.0f,2.0f}){
        for(uint32_t v=0;v<n;++v) guide[v]=g[v]*pull;
        double t5=now();
        uint32_t w=growth.run(guide.data(), seq.data());
        if(n>1000) fprintf(stderr," %g: %u (%.2f s)",pull,w,now()-t5);
        if(w<widest_best){widest_best=w;best=seq;}
      }
      if(n>1000) fprintf(stderr,"\n");
      int iters=getenv("IT")?atoi(getenv("IT")):0;
      seq=best;
      for(int it=0;it<iters;++it){
        layers(seq);
        int blur=getenv("BLUR")?atoi(getenv("BLUR")):2;
        for(int b=0;b<blur;++b){ for(uint32_t v=0;v<n;++v){ float s=g[v]; for(uint32_t i=view.first[v];i<view.first[v+1];++i) s+=g[view.neighbour[i]]; guide[v]=s/(1+view.first[v+1]-view.first[v]); } g.swap(guide);}        
        uint32_t wb=~0u; std::vector<uint32_t> sb;
        for(float pull: {0.5f,1.0f,2.0f}){
          for(uint32_t v=0;v<n;++v) guide[v]=g[v]*pull;
          uint32_t w=growth.run(guide.data(), seq.data());
          if(n>1000) fprintf(stderr," %g: %u",pull,w);
          if(w<wb){wb=w;sb=seq;}
          if(w<widest_best){widest_best=w;best=seq;}
        }
        seq=sb;
      if(n>1000) fprintf(stderr,"\n");
      }
    }
    for(uint32_t i=0;i<n;++i) rank[member[start[c]+best[i]]]=start[c]+n-1-i;
  }
}
}
