#include "framework/output/time_series.hpp"

#include <gmock/gmock.h>
#include <vtkNew.h>
#include <vtkXMLDataElement.h>
#include <vtkXMLDataParser.h>

#include "tests/framework/output/small_case.hpp"

namespace sprekk {
namespace {

using Pairs = std::vector<std::pair<std::string, std::string>>;

class TimeSeriesTest : public TemporaryFolder {
 protected:
  /// (timestep, file) of every entry, as VTK's own XML parser reads them.
  Pairs parsed() const {
    vtkNew<vtkXMLDataParser> parser;
    parser->SetFileName(pvd.c_str());
    EXPECT_EQ(parser->Parse(), 1);
    vtkXMLDataElement* root = parser->GetRootElement();
    if (!root) return {};
    EXPECT_STREQ(root->GetName(), "VTKFile");
    EXPECT_STREQ(root->GetAttribute("type"), "Collection");
    vtkXMLDataElement* collection = root->FindNestedElementWithName("Collection");
    Pairs result;
    for (int i = 0; i < collection->GetNumberOfNestedElements(); ++i) {
      vtkXMLDataElement* entry = collection->GetNestedElement(i);
      result.emplace_back(entry->GetAttribute("timestep"), entry->GetAttribute("file"));
    }
    return result;
  }
  std::filesystem::path pvd = folder / "matrix.pvd";
};

TEST_F(TimeSeriesTest, IsValidXmlAfterEveryEntry) {
  TimeSeries series(pvd);
  EXPECT_FALSE(std::filesystem::exists(pvd));
  series.add(0, "a.vtu");
  EXPECT_EQ(parsed(), (Pairs{{"0", "a.vtu"}}));
  series.add(0.1, "b.vtu");
  series.add(1e9 / 3, "c.vtu");
  ASSERT_EQ(parsed().size(), 3u);
  EXPECT_EQ(parsed()[1], (std::pair<std::string, std::string>("0.1", "b.vtu")));
  EXPECT_EQ(std::stod(parsed()[2].first), 1e9 / 3);
}

TEST_F(TimeSeriesTest, NamesAreEscaped) {
  const std::string name = "a<b>&\"c\"&lt;.vtu";
  TimeSeries series(pvd);
  series.add(0, name);
  EXPECT_EQ(parsed(), (Pairs{{"0", name}}));
  EXPECT_EQ(TimeSeries::continued(pvd, 0).entries().at(0).file, name);
}

TEST_F(TimeSeriesTest, ARestartKeepsWhatWasUpToItsTime) {
  const double third = 1.0 / 3;
  TimeSeries series(pvd);
  series.add(0, "0.vtu");
  series.add(third, "1.vtu");
  series.add(std::nextafter(third, 1), "2.vtu");
  TimeSeries continued = TimeSeries::continued(pvd, third);
  continued.add(0.5, "3.vtu");
  ASSERT_EQ(parsed().size(), 3u);
  EXPECT_EQ(parsed()[1].second, "1.vtu");
  EXPECT_EQ(parsed()[2].second, "3.vtu");
}

TEST_F(TimeSeriesTest, AnEntryOfTheSameTimeIsReplaced) {
  TimeSeries series(pvd);
  series.add(1, "a.vtu");
  series.add(2, "b.vtu");
  series.add(2, "c.vtu");
  EXPECT_EQ(parsed(), (Pairs{{"1", "a.vtu"}, {"2", "c.vtu"}}));
}

TEST_F(TimeSeriesTest, AMissingIndexIsAnEmptyOneAndABrokenOneIsRefused) {
  EXPECT_TRUE(TimeSeries::continued(pvd, 1).entries().empty());
  TimeSeries(pvd).add(0, "a.vtu");
  const std::string whole = read_text(pvd);
  write_text(pvd, whole.substr(0, whole.size() / 2));
  EXPECT_THAT(input_error_of([&] { TimeSeries::continued(pvd, 1); }), testing::HasSubstr(pvd.string()));
}

}  // namespace
}  // namespace sprekk
