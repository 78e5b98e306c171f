#include <cstdio>
#include <algorithm>
#include <cmath>
#include "examples.h"
#include "burnish/core/edges.h"
#include "burnish/smoothing/normal_fusion.h"
#include "burnish/io/geometry_file.h"
using namespace burnish; using namespace burnish::training;
void stat(const char* name, const TriangleMesh& m) {
  std::vector<Vec3d> p(m.positions.begin(), m.positions.end());
  auto faces = face_geometry(p, m.triangles, mean_edge_length(m)); auto around = faces_around_faces(m); NormalCandidates c; (void)normal_candidates(faces, around, {}, c);
  std::printf("%s", name);
  for (double q : {.25, .5}) for (auto [a,b] : {std::pair{0,1},{1,2},{2,3},{3,4}}) { std::vector<float> d; for (size_t f=0; f<m.triangles.size();++f){auto x=c.of(f); d.push_back(2-2*float(dot(Vec3d(x[a]),Vec3d(x[b]))));} std::nth_element(d.begin(), d.begin()+size_t(q*d.size()), d.end()); std::printf(" %.5f", d[size_t(q*d.size())]); }
  // correlation of residual along edges
  std::vector<std::vector<uint32_t>> ring(m.positions.size()); auto rings = one_rings(m);
  auto vn = vertex_normals(m); std::vector<Vec3d> sn(vn.size()); for(size_t v=0;v<vn.size();++v){Vec3d s(vn[v]); for(auto w:rings.row(v)) s+=Vec3d(vn[w]); sn[v]=normalized(s);}
  std::vector<double> h(vn.size()); for(size_t v=0;v<h.size();++v){ Vec3d s; auto r=rings.row(v); if(r.empty())continue; for(auto w:r) s+=p[w]; h[v]=dot(sn[v],p[v]-s/double(r.size())); }
  // robust: sign correlation of h with mean of neighbours' h
  long same=0,all=0; for(size_t v=0;v<h.size();++v) for(auto w:rings.row(v)) if(h[v]!=0&&h[w]!=0){ same+=(h[v]>0)==(h[w]>0); ++all; }
  std::printf("  sign %.3f\n", double(same)/all);
}
int main() {
  for (auto& e : white_examples(14, 5)) stat("white ", e.noisy);
  for (auto& e : camera_examples(14, 5)) stat("camera", e.noisy);
  for (const char* f : {"guided_denoising/Fandisk0.3/Noisy.obj","meshtgv/Kinect/Pyramid/noisy.obj","resgem_cnr_synthetic_derived/fertility_n2.obj","resgem_cnr_synthetic_derived/sphere_n1.obj","resgem_cnr_synthetic_derived/trim-star_n1.obj","resgem_cnr_synthetic_derived/trim-star_n3.obj"}) { auto g = read_geometry(std::string("/work/shared/data/denoise/")+f); stat(f+20, g->mesh); }
}
