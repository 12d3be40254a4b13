#include "OrderNumbers.hpp"

#include "Catch.hpp"

#include <cstdint>
#include <limits>

namespace ACS::VDA5050::Test
{

TEST_CASE("6.6.2 The number of an update is above those that were used and the one that the vehicle shows")
{
    OrderNumbers numbers(3, {});
    CHECK(numbers.TakeOrNull(0) == 4U);
    CHECK(numbers.TakeOrNull(9) == 10U);
    CHECK(numbers.TakeOrNull(9) == 11U);
    CHECK_FALSE(numbers.TakeOrNull(std::numeric_limits<std::uint32_t>::max()).has_value());
}

TEST_CASE(
    "6.6.2 More nodes follow after an order that was built with a horizon, until an update without one is accepted")
{
    OrderNumbers numbers(0, {0});
    CHECK_FALSE(numbers.IsAccepted());
    CHECK_FALSE(numbers.IsContinued());
    numbers.Accept(0);
    CHECK(numbers.IsAccepted());
    CHECK(numbers.IsContinued());
    CHECK(numbers.TakeOrNull(0) == 1U);
    CHECK(numbers.IsContinued());
    numbers.Accept(1);
    CHECK_FALSE(numbers.IsContinued());
}

TEST_CASE("6.6.2 A message that gets another number keeps its horizon")
{
    OrderNumbers numbers(0, {});
    numbers.Accept(0);
    std::uint32_t updateID = numbers.TakeOrNull(0).value_or(0);
    numbers.SetContinued(updateID);
    REQUIRE(numbers.TryRenumber(updateID, 5));
    CHECK(updateID == 6);
    numbers.Accept(5);
    CHECK_FALSE(numbers.IsContinued());
    numbers.Accept(updateID);
    CHECK(numbers.IsContinued());
    CHECK_FALSE(numbers.TryRenumber(updateID, std::numeric_limits<std::uint32_t>::max()));
    CHECK(updateID == 6);
}

} // namespace ACS::VDA5050::Test
