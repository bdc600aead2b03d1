#include <chrono>
#include <iostream>
#include "tests/unit/dynamics/blocks.hpp"
namespace mechane::dynamics::test {
namespace {
const Vec3 kBlock(0.05, 0.03, 0.04);
void print(const char* what, const state::BodyState& b){
  std::cout<<what<<" p "<<b.X_WB.p.transpose()<<" rot "<<rotation_vector(b.X_WB.R).transpose()<<" v "<<b.V_WB.v.transpose()<<" w "<<b.V_WB.w.transpose()<<"\n";
}
TEST(X, Drop){
  auto t0=std::chrono::steady_clock::now();
  auto o=box_object(kTableHalf_m); box_object(kBlock);
  std::cout<<"build "<<std::chrono::duration<double>(std::chrono::steady_clock::now()-t0).count()<<" table map "<<o->parts[0].map.name()<<" block "<<box_object(kBlock)->parts[0].map.name()<<" samples "<<o->clusters.size()*16<<" "<<box_object(kBlock)->clusters.size()*16<<"\n";
  Scene s(world_of({table(), block("B",kBlock,{{0.013,0.03+0.05,0.007},quat_from_rotation_vector({0.2,0.3,0.1})})}));
  for(int i=0;i<40;++i){ s.run(0.05); if(i<10||i%5==0) print("drop",s.at(1)); }
  s.run(5); print("after",s.at(1));
}
TEST(X, Slide){
  for(double v: {0.05,0.2,1.0}){
  Scene s(world_of({table(0,0.3), block("B",kBlock,{{-0.15,0.03,0.007},Quat::Identity()},0.3)}));
  s.at(1).V_WB.v=Vec3(v,0,0);
  s.run(1); print("slid",s.at(1));
  std::cout<<"moved "<<s.at(1).X_WB.p.x()+0.15<<" of "<<v*v/(2*0.3*9.81)<<"\n";
  }
}
TEST(X, Slope){
  for(double mu:{0.45,0.55}){
    double a=std::atan(0.5);
  Quat R(Eigen::AngleAxisd(a, Vec3::UnitZ()));
  Scene s(world_of({table(a,mu), block("B",kBlock,{R*Vec3(0.1,0.03,0),R},mu)}));
  for(int i=0;i<4;++i){
  s.run(0.25); print("slope",s.at(1)); std::cout<<"along "<<(R.conjugate()*s.at(1).X_WB.p).transpose()<<"\n";}
  double g=9.81*(std::sin(a)-mu*std::cos(a)); std::cout<<"expect "<<g/2<<"\n";
  }
}
TEST(X, Stack){
  Scene s(world_of({table(), block("A",kBlock,{{0.0,0.03,0.0},Quat::Identity()}), block("B",kBlock,{{0.01,0.0901,0.005},quat_from_rotation_vector({0,0.3,0})}), block("C",kBlock,{{0.0,0.1502,-0.005},quat_from_rotation_vector({0,-0.2,0})})}));
  for(int i=0;i<8;++i){ s.run(0.5); print("A",s.at(1)); print("B",s.at(2)); print("C",s.at(3)); }
}
TEST(X, Time){
  std::vector<state::BodyDescription> b{table()};
  for(int i=0;i<20;++i) b.push_back(block(std::string(1,static_cast<char>(65+i)),Vec3(0.03,0.02,0.025),{{-0.2+0.1*(i%5),0.02+0.041*(i/5),0.003*(i%3)},quat_from_rotation_vector({0,0.1*i,0})}));
  Scene s(world_of(b));
  for(int k=0;k<5;++k){
  timespec a,b2; clock_gettime(CLOCK_THREAD_CPUTIME_ID,&a);
  s.run(0.2);
  clock_gettime(CLOCK_THREAD_CPUTIME_ID,&b2);
  std::cout<<"us per step "<<(double(b2.tv_sec-a.tv_sec)*1e9+double(b2.tv_nsec-a.tv_nsec))/1000./200<<"\n";
  }
  for(int i=16;i<=20;++i) print("top",s.at(i));
}
}}
