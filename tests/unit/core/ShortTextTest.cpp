#include "Catch.hpp"
#include <acs/core/ShortText.hpp>

using ACS::Core::MOST_SHOWN;
using ACS::Core::ShortenText;

TEST_CASE("A text of a peer is shown whole if it is short, else shortened between two characters")
{
    const std::string umlaut = "\xC3\xBC"; // of two bytes
    CHECK(ShortenText("").empty());
    CHECK(ShortenText("short") == "short");
    CHECK(ShortenText(std::string(MOST_SHOWN, 'x')) == std::string(MOST_SHOWN, 'x'));
    CHECK(ShortenText(std::string(10'000, 'x')) == std::string(MOST_SHOWN, 'x') + "...");
    CHECK(ShortenText(std::string(MOST_SHOWN - 1, 'x') + umlaut + "y") == std::string(MOST_SHOWN - 1, 'x') + "...");
    CHECK(
        ShortenText(std::string(MOST_SHOWN - 2, 'x') + umlaut + "y")
        == std::string(MOST_SHOWN - 2, 'x') + umlaut + "...");
}
