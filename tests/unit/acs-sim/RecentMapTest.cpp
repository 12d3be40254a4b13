#include "RecentMap.hpp"

#include "Catch.hpp"

#include <cstddef>
#include <string>

namespace ACS::AcsSim
{

TEST_CASE("A map of recent entries keeps the first value of a key and forgets the oldest key")
{
    RecentMap<std::size_t> map;
    for (std::size_t i = 0; i < RecentMap<std::size_t>::MOST_ENTRIES; ++i)
    {
        CHECK(map.Add(std::to_string(i), i).second);
    }
    const auto [value, bNew] = map.Add("0", 7);
    CHECK_FALSE(bNew);
    CHECK(*value == 0);
    CHECK(*map.Add("new", 8).first == 8);
    CHECK(map.FindOrNull("0") == nullptr);
    REQUIRE(map.FindOrNull("1") != nullptr);
    CHECK(*map.FindOrNull("1") == 1);
    CHECK(map.GetEntries().size() == RecentMap<std::size_t>::MOST_ENTRIES);
}

} // namespace ACS::AcsSim
