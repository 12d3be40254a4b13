#include "Catch.hpp"
#include <acs/core/ParseNumber.hpp>

#include <cmath>
#include <cstdint>

namespace ACS::Testing
{

TEST_CASE("A text is a number only as a whole and within the range of the type")
{
    CHECK(Core::ParseNumberOrNull<int>("-12") == -12);
    CHECK(Core::ParseNumberOrNull<std::uint16_t>("65535") == 65'535);
    CHECK(Core::ParseNumberOrNull<double>("1.5e3") == 1'500.0);
    CHECK(std::isinf(Core::ParseNumberOrNull<double>("inf").value_or(0.0)));
    for (const char* const text : {"", " 1", "1 ", "+1", "1x", "x", "0x1", "1.5"})
    {
        CHECK_FALSE(Core::ParseNumberOrNull<int>(text).has_value());
    }
    CHECK_FALSE(Core::ParseNumberOrNull<unsigned>("-1").has_value());
    CHECK_FALSE(Core::ParseNumberOrNull<std::uint16_t>("65536").has_value());
    CHECK_FALSE(Core::ParseNumberOrNull<double>("1e999").has_value());
}

} // namespace ACS::Testing
