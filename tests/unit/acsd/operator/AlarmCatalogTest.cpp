#include "operator/AlarmCatalog.hpp"

#include "Catch.hpp"

#include <algorithm>
#include <cstddef>
#include <set>
#include <string>

namespace ACS::Acsd::Test
{

TEST_CASE("Each code has its own entry; other codes have that of their prefix or that of all others")
{
    for (const AlarmDescription& entry : GetAlarmCatalog())
    {
        CHECK(&DescribeAlarm(entry.errorCode) == &entry);
    }
    CHECK(DescribeAlarm("ACS-1002").title == "Robot disconnected");
    CHECK(DescribeAlarm("AGV-mapNotEnabled").errorCode == "AGV-mapNotEnabled");
    CHECK(DescribeAlarm("AGV-lidarDirty").errorCode == "AGV-*");
    CHECK(DescribeAlarm("AGV-").errorCode == "AGV-*");
    CHECK(DescribeAlarm("ACS-9999").errorCode == "*");
    CHECK(DescribeAlarm("agv-lidarDirty").errorCode == "*");
    CHECK(DescribeAlarm("").errorCode == "*");
}

TEST_CASE("The entries of the alarm catalogue are unique and short, and name commands between backticks")
{
    std::set<std::string_view> codes;
    std::set<std::string_view> titles;
    for (const AlarmDescription& entry : GetAlarmCatalog())
    {
        INFO(entry.errorCode);
        CHECK(codes.insert(entry.errorCode).second);
        CHECK(titles.insert(entry.title).second);
        CHECK_FALSE(entry.title.ends_with('.'));
        CHECK(entry.cause.ends_with('.'));
        CHECK(entry.remedy.ends_with('.'));
        const std::string remedy = std::string(entry.remedy) + ' ';
        std::size_t sentences = 0;
        for (std::size_t end = remedy.find(". "); end != std::string::npos; end = remedy.find(". ", end + 1))
        {
            ++sentences;
        }
        CHECK(sentences <= 2);
        CHECK(std::ranges::count(entry.cause, '`') % 2 == 0);
        CHECK(std::ranges::count(entry.remedy, '`') % 2 == 0);
        for (std::size_t at = remedy.find("acsctl"); at != std::string::npos; at = remedy.find("acsctl", at + 1))
        {
            CHECK(remedy[at - 1] == '`');
        }
    }
}

} // namespace ACS::Acsd::Test
