#include "common/trace/LineCollector.hpp"

#include "Catch.hpp"

#include <string>
#include <string_view>
#include <vector>

namespace ACS::Testing
{

namespace
{

struct CollectorFixture
{
    Apps::LineCollector collector;
    std::vector<std::string> lines;
    Apps::LineCollector::LineHandler handler = [this](std::string_view line) {
        lines.emplace_back(line);
    };
};

} // namespace

TEST_CASE_METHOD(CollectorFixture, "Bytes become lines wherever they are cut; empty lines and line ends are omitted")
{
    collector.Add("{\"a\":1}\r\n{\"b\"", handler);
    CHECK(lines == std::vector<std::string>{R"({"a":1})"});
    collector.Add(":2}\n\n\r\n{\"c\":3}\n{\"d", handler);
    CHECK(lines == std::vector<std::string>{R"({"a":1})", R"({"b":2})", R"({"c":3})"});
    collector.Finish(handler);
    CHECK(lines.back() == R"({"d)");
    collector.Finish(handler);
    CHECK(lines.size() == 4);
}

TEST_CASE_METHOD(CollectorFixture, "A line without an end does not fill the memory")
{
    constexpr std::size_t MEGABYTE = 1024U * 1024U;
    collector.Add(std::string(MEGABYTE, 'x'), handler);
    CHECK(lines.empty());
    collector.Add("y", handler);
    REQUIRE(lines.size() == 1);
    CHECK(lines[0].size() == MEGABYTE + 1);
    collector.Add("z\n", handler);
    CHECK(lines.back() == "z");
}

} // namespace ACS::Testing
