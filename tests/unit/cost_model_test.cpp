#include "render/cost_model.h"

#include <gtest/gtest.h>

namespace facemap {
namespace {

using Strategy = Renderer::Strategy;

PictureWork work(std::size_t faces, std::size_t samples) {
  PictureWork result;
  result.faces = faces;
  result.samples = samples;
  result.lights = 8;
  return result;
}

TEST(CostModel, AWholePictureTakesTheTransposedWay) {
  EXPECT_EQ(choose_strategy({}, work(100'000, 1'000'000)).strategy, Strategy::Transposed);
  EXPECT_EQ(choose_strategy({}, work(10'000'000, 1'000'000)).strategy, Strategy::Transposed);
}

TEST(CostModel, ManySmallPicturesOfOneSceneBuildListsOnce) {
  PictureWork thumbnail = work(1'000'000, 64 * 64);
  EXPECT_EQ(choose_strategy({}, thumbnail).strategy, Strategy::Transposed);
  int frames = 0;
  while (choose_strategy({}, thumbnail).strategy == Strategy::Transposed && frames < 1000) {
    const PictureCost cost = estimate_cost(thumbnail);
    thumbnail.spent_in_vain += cost.transposed - cost.lists;
    ++frames;
  }
  EXPECT_GT(frames, 2);
  EXPECT_LT(frames, 100);
  // What was spent before is about what building costs: never more than twice the better way in hindsight.
  EXPECT_LE(thumbnail.spent_in_vain, 1.2 * estimate_cost(thumbnail).build_lists);
  thumbnail.has_lists = true;
  EXPECT_EQ(choose_strategy({}, thumbnail).strategy, Strategy::Lists);
}

TEST(CostModel, ListsThatDoNotFitTheMemoryAreNotBuilt) {
  PictureWork thumbnail = work(1'000'000, 64 * 64);
  thumbnail.spent_in_vain = 1e9;
  EXPECT_EQ(choose_strategy({}, thumbnail).strategy, Strategy::Lists);
  Renderer::Options options;
  thumbnail.map_memory = 1 << 20;
  EXPECT_EQ(choose_strategy(options, thumbnail).strategy, Strategy::Transposed);
}

TEST(CostModel, WhatIsAskedForIsDone) {
  Renderer::Options options;
  options.strategy = Strategy::Lists;
  EXPECT_EQ(choose_strategy(options, work(100'000, 1'000'000)).strategy, Strategy::Lists);
  options.strategy = Strategy::Transposed;
  EXPECT_EQ(choose_strategy(options, work(100'000, 100)).strategy, Strategy::Transposed);
  options.samples = 4;
  options.sampling = Renderer::Sampling::Edges;
  EXPECT_EQ(choose_strategy(options, work(100'000, 1'000'000)).strategy, Strategy::Transposed);
  options.samples = 1;  // sample by sample
  EXPECT_EQ(choose_strategy(options, work(100'000, 1'000'000)).strategy, Strategy::Lists);
}

}  // namespace
}  // namespace facemap
