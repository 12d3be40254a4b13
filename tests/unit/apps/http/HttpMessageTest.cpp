#include "common/http/HttpMessage.hpp"

#include "Catch.hpp"

namespace Apps = ACS::Apps;

TEST_CASE("A path is the same with encoded and unencoded brackets")
{
    const auto* const target =
        GENERATE("/project/robot/tasks[0]", "/project/robot/tasks%5B0%5D", "/project/robot/tasks%5b0%5d");
    const auto request = Apps::ParseHttpTarget(target);
    REQUIRE(request.has_value());
    REQUIRE(request->path == "/project/robot/tasks[0]");
    REQUIRE(request->query.empty());
}

TEST_CASE("Query parameters are decoded; the first one of a name is used")
{
    const auto request = Apps::ParseHttpTarget("/a+b?type=io&x=1%262&x=3&flag&&text=a+b%3D");
    REQUIRE(request.has_value());
    REQUIRE(request->path == "/a+b");
    REQUIRE(request->query.size() == 5);
    REQUIRE(request->GetQueryOrNull("x") == "1&2");
    REQUIRE(request->GetQueryOrNull("flag") == "");
    REQUIRE(request->GetQueryOrNull("text") == "a b=");
    REQUIRE_FALSE(request->GetQueryOrNull("y").has_value());
}

TEST_CASE("The segments of a path are split before they are decoded")
{
    const auto request = Apps::ParseHttpTarget("/plans/PLAN%2F1//done/?a/b");
    REQUIRE(request.has_value());
    REQUIRE(request->segments == std::vector<std::string>{"plans", "PLAN/1", "", "done", ""});
    REQUIRE(Apps::ParseHttpTarget("/")->segments == std::vector<std::string>{""});
}

TEST_CASE("A target that is not an encoded path is refused")
{
    const auto* const target =
        GENERATE("", "*", "x", "?a=b", "/%", "/%5", "/%5x", "/%x5", "/%-1", "/a?b=%zz", "/a?%2=1", "%2Fa");
    CAPTURE(target);
    REQUIRE_FALSE(Apps::ParseHttpTarget(target).has_value());
}

TEST_CASE("A header is found in any case; the first of several counts")
{
    ACS::Apps::HttpRequest request;
    request.headers = {{"cookie", "a=1"}, {"Cookie", "a=2"}};
    CHECK(request.GetHeaderOrNull("Cookie") == "a=1");
    CHECK(request.GetHeaderOrNull("Cookies") == std::nullopt);
}
