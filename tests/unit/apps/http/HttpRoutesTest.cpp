#include "common/http/HttpRoutes.hpp"

#include "Catch.hpp"

namespace Apps = ACS::Apps;

namespace
{

Apps::HttpResponse Ask(const Apps::HttpRoutes& routes, const std::string& method, std::string_view target)
{
    auto request = Apps::ParseHttpTarget(target);
    REQUIRE(request.has_value());
    request->method = method;
    return routes.Respond(*request);
}

Apps::HttpRoutes MakeRoutes()
{
    Apps::HttpRoutes routes;
    routes.Add("GET", "/status", [](const auto&, const auto&) { return Apps::HttpResponse{200, "", "status"}; });
    routes.Add("POST", "/plans/{PLAN}/jobs/{JOB}/done", [](const auto& request, const auto& captures) {
        return Apps::HttpResponse{202, "", captures.at(0) + "|" + captures.at(1) + "|" + request.body};
    });
    return routes;
}

} // namespace

TEST_CASE("A route is found by method and path, and has the captured segments decoded")
{
    const Apps::HttpRoutes routes = MakeRoutes();
    REQUIRE(Ask(routes, "GET", "/status?verbose=1").body == "status");
    const Apps::HttpResponse done = Ask(routes, "POST", "/plans/PLAN%2F1/jobs/a%20b/done");
    REQUIRE(done.status == 202);
    REQUIRE(done.body == "PLAN/1|a b|");
}

TEST_CASE("A path of another method is answered with 405 and the allowed methods")
{
    const Apps::HttpRoutes routes = MakeRoutes();
    REQUIRE(Ask(routes, "POST", "/status").status == 405);
    REQUIRE(Ask(routes, "POST", "/status").allow == "GET, HEAD");
    REQUIRE(Ask(routes, "GET", "/plans/P/jobs/J/done").body == "allowed methods: POST\n");
    REQUIRE(Ask(routes, "HEAD", "/plans/P/jobs/J/done").allow == "POST");
}

TEST_CASE("Refusals are made by the owner, with the same text and the allowed methods")
{
    Apps::HttpRoutes routes([](unsigned status, const std::string& text) {
        return Apps::HttpResponse{status, "x", "<" + text + ">"};
    });
    routes.Add("GET", "/status", [](const auto&, const auto&) { return Apps::HttpResponse(); });
    const Apps::HttpResponse unknown = Ask(routes, "GET", "/x");
    CHECK(unknown.status == 404);
    CHECK(unknown.contentType == "x");
    CHECK(unknown.body == "<not found; available paths:\nGET /status>");
    const Apps::HttpResponse method = Ask(routes, "POST", "/status");
    CHECK(method.status == 405);
    CHECK(method.allow == "GET, HEAD");
    CHECK(method.body == "<allowed methods: GET, HEAD>");
}

TEST_CASE("HEAD is allowed for every path with GET")
{
    const Apps::HttpResponse response = Ask(MakeRoutes(), "HEAD", "/status");
    REQUIRE(response.status == 200);
    REQUIRE(response.allow.empty());
}

TEST_CASE("An unknown path is answered with 404 and the available paths")
{
    const Apps::HttpRoutes routes = MakeRoutes();
    const auto* const target =
        GENERATE("/", "/statu", "/status/", "/plans/P/jobs//done", "/plans/P/jobs/done", "/plans/P/jobs/J/done/x");
    CAPTURE(target);
    const Apps::HttpResponse response = Ask(routes, "POST", target);
    REQUIRE(response.status == 404);
    REQUIRE(response.body.find("GET /status\n") != std::string::npos);
    REQUIRE(response.body.find("POST /plans/{PLAN}/jobs/{JOB}/done\n") != std::string::npos);
}
