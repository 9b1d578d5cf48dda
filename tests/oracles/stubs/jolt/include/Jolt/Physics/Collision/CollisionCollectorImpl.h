#pragma once

#include "Jolt/Physics/Collision/ShapeCast.h"

namespace JPH {

template <class Result>
class CollisionCollector {
 public:
  using ResultType = Result;
  virtual ~CollisionCollector() = default;
  virtual void AddHit(const Result& hit) = 0;
};
using CollideShapeCollector = CollisionCollector<CollideShapeResult>;
using CastShapeCollector = CollisionCollector<ShapeCastResult>;

template <class Collector>
class ClosestHitCollisionCollector : public Collector {
 public:
  using Result = typename Collector::ResultType;
  void AddHit(const Result& hit) override {
    if (had_ && hit.GetEarlyOutFraction() >= mHit.GetEarlyOutFraction()) return;
    mHit = hit;
    had_ = true;
  }
  bool HadHit() const { return had_; }
  Result mHit;

 private:
  bool had_ = false;
};

}  // namespace JPH
