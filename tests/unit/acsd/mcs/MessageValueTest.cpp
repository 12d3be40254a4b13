#include "mcs/MessageValue.hpp"

#include "Catch.hpp"
#include "config/ExampleSite.hpp"

#include <string>

namespace ACS::Acsd::Test
{

TEST_CASE("A value that a message to a vehicle cannot have is an error of the configuration")
{
    const std::string load = "actions.CassetteLoad.parameters";
    const std::string own = "robots.LR01.actions.CassetteLoad.parameters";
    CheckErrors({
        {{load + ".a=nan"}, load + ".a: expected a finite number, found nan"},
        {{load + ".a=inf"}, load + ".a: expected a finite number, found inf"},
        {{load + ".a=-inf"}, load + ".a: expected a finite number, found -inf"},
        {{load + ".a={b=[1, nan]}"}, load + ".a: expected a finite number"},
        {{own + ".a=nan"}, own + ".a: expected a finite number"},
        {{load + R"(.a="x\u0000y")"}, load + ".a: expected text without the character U+0000, found \"x?y\""},
        {{load + R"(.a={b="\u0000"})"}, load + ".a: expected text without the character U+0000"},
        {{load + R"(.""=1)"}, load + ": expected a name of at least one character"},
        {{load + R"(."a\u0000"=1)"},
         load + R"(."a\u0000": expected a name of at least one character, without control)"},
        {{load + R"(.a={""=1})"}, load + ".a: expected a name of at least one character"},
        {{load + R"(.a={"b\u0000"=1})"}, load + ".a: expected a name"},
        {{R"(actions.CassetteLoad.vehicle_action="pick\u0000")"},
         "actions.CassetteLoad.vehicle_action: expected a name"},
        {{R"(robots.LR01.load_positions.CP01="\u0000")"}, "robots.LR01.load_positions.CP01: expected a name"},
        {{R"(stations."A01.CP01".lane=nan)"}, R"(stations."A01.CP01".lane: expected a finite number)"},
        {{R"(stations."A01.CP01".lane="\u0000")"}, R"(stations."A01.CP01".lane: expected text without)"},
        {{R"(stations."A01.CP01".side="\u0000")"}, R"(stations."A01.CP01".side: expected text without)"},
        {{R"(stations."A01.CP01".type="\u0000")"}, R"(stations."A01.CP01".type: expected text without)"},
        {{R"(stations."A01.CP01".height=nan)"}, R"(stations."A01.CP01".height: expected a number from)"},
    });
    CHECK(ReadSite({load + R"(={a=1.5, b="", c="two\nlines", d={e=[-0.0, 1e308]}})"}).errors.empty());
}

} // namespace ACS::Acsd::Test
