// A broad phase as a plug-in, in C++: all pairs of boxes tested. Replace Mine with your own.
//   c++ -std=c++17 -O2 -shared -fPIC -I PREFIX/include broad_phase.cpp -o libmine.so
#include <iterator>
#include <map>
#include "oracles/abi/broad_phase_plugin.h"

struct Mine {
  void insert(int body, const ts_aabb& box) { boxes[body] = box; }
  void move(int body, const ts_aabb& box) { boxes[body] = box; }
  void remove(int body) { boxes.erase(body); }

  template <class Report>
  void query(Report report) const {
    for (auto a = boxes.begin(); a != boxes.end(); ++a)
      for (auto b = std::next(a); b != boxes.end(); ++b)
        if (overlap(a->second, b->second)) report(a->first, b->first);
  }

 private:
  // Touching counts as overlap.
  static bool overlap(const ts_aabb& a, const ts_aabb& b) {
    for (int k = 0; k < 3; ++k)
      if (!(a.lower[k] <= b.upper[k] && b.lower[k] <= a.upper[k])) return false;
    return true;
  }
  std::map<int, ts_aabb> boxes;
};

TS_BROAD_PHASE(Mine, R"({"name":"mine","library":"mine","version":"1","settings":"all pairs of boxes",)"
                     R"("unit_roundoff":1.1102230246251565e-16,"tau_factor":64,"source":"arithmetic only"})")
