// SPDX-License-Identifier: BSD-3-Clause
#include "ViewSelection.h"

#include "CaptureTesting.h"

using namespace silhouette;

namespace
{

const std::vector<std::string> Names = {"a.png", "b.png", "3", "view-4.png", "c.d.png", "c.d.jpg"};

std::vector<int> selected(const std::string& selection)
{
  return selectViews(selection, Names);
}

std::string error(const std::string& selection)
{
  return errorOf([&] { selectViews(selection, Names); });
}

} // namespace

TEST(ViewSelection, NamesIndicesAndRanges)
{
  EXPECT_EQ(selected(""), (std::vector<int>{0, 1, 2, 3, 4, 5}));
  EXPECT_EQ(selected(" "), (std::vector<int>{0, 1, 2, 3, 4, 5}));
  EXPECT_EQ(selected("0"), (std::vector<int>{0}));
  EXPECT_EQ(selected("5, 0 ,0-2"), (std::vector<int>{0, 1, 2, 5}));
  EXPECT_EQ(selected("b.png,a"), (std::vector<int>{0, 1}));
  EXPECT_EQ(selected("view-4.png"), (std::vector<int>{3}));
  EXPECT_EQ(selected("view-4"), (std::vector<int>{3}));
  EXPECT_EQ(selected("3"), (std::vector<int>{2})) << "a name goes before an index";
  EXPECT_EQ(selected("3-3"), (std::vector<int>{3}));
  EXPECT_EQ(selected("c.d.jpg"), (std::vector<int>{5}));
}

TEST(ViewSelection, ImagesThatAreCalledByNumbers)
{
  const std::vector<std::string> names = {"1.png", "2.png", "3.png", "4.png"};
  EXPECT_EQ(selectViews("1-2", names), (std::vector<int>{1, 2}));
  EXPECT_EQ(selectViews("2.png,4", names), (std::vector<int>{1, 3})) << "4 is no index";
  EXPECT_EQ(selectViews("0", names), (std::vector<int>{0})) << "0 is no image";
  EXPECT_EQ(errorOf([&] { selectViews("0,2", names); }),
            "views: '2' is the image '2.png', and the index of '3.png'; write the whole name, or 2-2");
  const std::vector<std::string> same = {"0.png", "1.png"};
  EXPECT_EQ(selectViews("1", same), (std::vector<int>{1}));
}

TEST(ViewSelection, Errors)
{
  EXPECT_EQ(error("0,x.png"),
            "views: 'x.png' is neither the name of a view nor an index (as in 0,3,5-9) from 0 to 5");
  EXPECT_EQ(error("6"), "views: '6' is out of range: the capture has views 0 to 5");
  EXPECT_EQ(error("4-9"), "views: '4-9' is out of range: the capture has views 0 to 5");
  EXPECT_EQ(error("5-1"), "views: the range '5-1' runs backwards");
  EXPECT_EQ(error("c.d"), "views: 'c.d' fits both 'c.d.png' and 'c.d.jpg'");
  for (const char* bad : {",", "0,", "-1", "1-", "1-2-3", "1.5", "99999999999", "0-99999999999"})
  {
    EXPECT_TRUE(holds(error(bad), "is neither the name")) << bad;
  }
}
