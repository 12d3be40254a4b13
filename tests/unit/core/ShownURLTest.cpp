#include "Catch.hpp"
#include <acs/core/ShownURL.hpp>

#include <string>
#include <utility>

TEST_CASE("A URL is shown without its user information and its query")
{
    using Row = std::pair<const char*, const char*>;
    const auto [url, shown] = GENERATE(
        Row{"ws://mcs:9001/acs/", "ws://mcs:9001/acs/"},
        Row{"ws://mcs/acs/?token=S3CRET", "ws://mcs/acs/?***"},
        Row{"wss://acs:Gehe1m@mcs:9001/acs/", "wss://***@mcs:9001/acs/"},
        Row{"wss://acs:Ge/he@1m@mcs?token=S3CRET", "wss://***@mcs?***"},
        Row{"acs:Gehe1m@mcs", "***@mcs"},
        Row{"?", "?***"},
        Row{"a@://b", "a@://b"},
        Row{"http://h/p#S3CRET", "http://h/p#***"},
        Row{"http://h/p#S3C?RET", "http://h/p#***"},
        Row{"http://h/p?S3C#RET", "http://h/p?***"},
        Row{"http://u:p#x/", "http://u:p#***"},
        Row{"http://u:Gehe?1m@host/", "http://***"},
        Row{"http://u:Gehe#1m@host/", "http://***"},
        Row{"http://h/?token=S3C@RET", "http://***"},
        Row{"u:Gehe?1m@host", "***"},
        Row{"", ""});
    CHECK(ACS::Core::MakeShownURL(url) == shown);
}
