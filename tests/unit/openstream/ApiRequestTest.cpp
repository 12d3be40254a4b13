#include "Catch.hpp"
#include <acs/openstream/ApiRequest.hpp>
#include <acs/openstream/OpenStreamCodec.hpp>

#include <string>

using namespace ACS::OpenStream; // NOLINT(google-build-using-namespace)
using ACS::Core::JsonText;

TEST_CASE("7.29 A url is an opaque path and a query; args are added to the query and override it")
{
    ApiRequest request;
    SplitURL("/project/context/tasks[0]/x%20y?jno_n=3&flag&&empty=", request);
    REQUIRE(request.path == "/project/context/tasks[0]/x%20y");
    REQUIRE(request.query.size() == 3);
    REQUIRE(*request.GetParameterOrNull("jno_n") == "3");
    REQUIRE(request.GetParameterOrNull("flag")->empty());
    REQUIRE(request.GetParameterOrNull("none") == nullptr);

    AddArguments(JsonText::FromTrusted(R"({"jno_n":6,"name":"a b","deep":{"x":[1,true]}})"), request);
    REQUIRE(*request.GetParameterOrNull("jno_n") == "6");
    REQUIRE(*request.GetParameterOrNull("name") == "a b");
    REQUIRE(*request.GetParameterOrNull("deep") == R"({"x":[1,true]})");
    REQUIRE(request.query.size() == 5);
}

TEST_CASE("7.29 The args of the longest line replace all parameters of their names")
{
    // Quadratic work would block the server, and every session, for minutes.
    constexpr std::size_t COUNT = 60'000;
    std::string args = "{";
    for (std::size_t i = 0; i < COUNT; ++i)
    {
        args += (i == 0 ? "\"" : ",\"") + std::to_string(i) + "\":" + std::to_string(i % 7);
    }
    ApiRequest request;
    SplitURL("/project/rgen?3=x&3=y&kept=1&59999=z", request);
    AddArguments(JsonText::FromTrusted(args + "}"), request);
    REQUIRE(request.query.size() == COUNT + 1);
    REQUIRE(*request.GetParameterOrNull("kept") == "1");
    REQUIRE(*request.GetParameterOrNull("3") == "3");
    REQUIRE(*request.GetParameterOrNull("59999") == "2");
}

TEST_CASE("7.29 BuildUrl encodes what a query cannot carry")
{
    ApiRequest request;
    request.path = "/project/robot/po_cur";
    REQUIRE(BuildURL(request) == "/project/robot/po_cur");
    request.query = {{"crd", "-1"}, {"text", "a b&c=\xC3\xA9"}};
    REQUIRE(BuildURL(request) == "/project/robot/po_cur?crd=-1&text=a%20b%26c%3D%C3%A9");
}

TEST_CASE("7.29 Names and values of a query are percent-decoded, except invalid escapes; the path is opaque")
{
    ApiRequest request;
    SplitURL("/a%20b?na%6de=x%20y%2B%26%3d&plus=1+2%2B3&bad=%&short=%2&wrong=%G0%0g&nul=%00", request);
    CHECK(request.path == "/a%20b");
    REQUIRE(request.query.size() == 6);
    CHECK(request.query.at(0) == QueryParameter{"name", "x y+&="});
    CHECK(*request.GetParameterOrNull("plus") == "1 2+3"); // as an HTTP server reads it
    CHECK(*request.GetParameterOrNull("bad") == "%");
    CHECK(*request.GetParameterOrNull("short") == "%2");
    CHECK(*request.GetParameterOrNull("wrong") == "%G0%0g");
    CHECK(*request.GetParameterOrNull("nul") == std::string(1, '\0'));
}

TEST_CASE("7.29 SplitUrl reads what BuildUrl has written")
{
    ApiRequest request;
    request.path = "/project/robot/po_cur";
    request.query = {{"a b", "100%"}, {"%20", "%41"}, {"c&d=e", "\xC3\xA9+/?"}, {"", ""}, {"empty", ""}};
    ApiRequest read;
    SplitURL(BuildURL(request), read);
    CHECK(read == request);
}

TEST_CASE("7.29 Blanks, control characters and relative urls are rejected; the rest is opaque")
{
    for (const char* good : {"/", "/a/../b", "/a#b?c=%zz", "/tasks[0]"})
    {
        REQUIRE(IsURL(good));
    }
    for (const char* bad : {"", "a", "/a b", "/a\tb", "/a\x7F", "http://x/"})
    {
        REQUIRE_FALSE(IsURL(bad));
    }
}

TEST_CASE("7.17 Every 2xx is a success")
{
    for (const int status : {200, 201, 204, 299})
    {
        REQUIRE(ApiResponse{status, {}}.IsSuccess());
    }
    for (const int status : {199, 300, 400, 403, 404, 500})
    {
        REQUIRE_FALSE(ApiResponse{status, {}}.IsSuccess());
    }
}

TEST_CASE("8 The memory of an answer is reused for the next one")
{
    ApiResponse response{403, JsonText::FromTrusted(std::string(1000, '7'))};
    const char* const place = response.body->GetText().data();
    std::string room = response.TakeRoom();
    REQUIRE(room.empty());
    REQUIRE(room.data() == place);
    REQUIRE(response == ApiResponse{});
    REQUIRE(response.TakeRoom().empty());
    response.delay = std::chrono::seconds(1);
    response.bNoSample = true;
    static_cast<void>(response.TakeRoom());
    REQUIRE(response == ApiResponse{});
}
