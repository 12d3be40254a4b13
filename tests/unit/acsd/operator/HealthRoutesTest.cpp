#include "operator/HealthRoutes.hpp"

#include "Catch.hpp"

#include <string>

namespace ACS::Acsd::Test
{

TEST_CASE("Requests need an address or a configured host name; web pages are refused")
{
    const Apps::HttpGuard guard = MakeHttpGuard({{"acs.local", 8080}, {"acs.example"}});
    const auto bServed = [&guard](const std::string& method, const std::string& path, const Apps::HttpSource& source) {
        Apps::HttpRequest request = *Apps::ParseHttpTarget(path);
        request.method = method;
        return !guard.GetRejectionReasonOrNull(request, source).has_value();
    };
    for (const char* host : {"127.0.0.1:8080", "acs.local:8080", "acs.example"})
    {
        CHECK(bServed("POST", "/v1/tsc/pause", {host, {}, {}}));
        CHECK_FALSE(bServed("POST", "/v1/tsc/pause", {host, "http://evil.example", {}}));
    }
    CHECK_FALSE(bServed("POST", "/v1/tsc/pause", {"evil.example", {}, {}}));
    for (const char* path : {"/v1/status", "/livez", "/readyz", "/metrics"})
    {
        CHECK_FALSE(bServed("GET", path, {"evil.example", {}, {}}));
        CHECK(bServed("GET", path, {"acs.example", {}, {}}));
    }
}

TEST_CASE("/readyz has a line for each not-ready reason, then isConnected as the MCS knows it")
{
    ProgramState program;
    program.links = {{"mcs", true}, {"mqtt", true}};
    CHECK(MakeReadyResponse(program).status == 200);
    CHECK(MakeReadyResponse(program).body == "ready\n");
    program.bConnected = true;
    CHECK(MakeReadyResponse(program).body == "ready\nisConnected=true\n");
    program.links = {{"mcs", false, "connected, not registered: mcs: registration refused"}, {"mqtt", false}};
    program.notReadyReasons = {"acsd draining for shutdown"};
    program.bConnected = false;
    CHECK(MakeReadyResponse(program).status == 503);
    CHECK(
        MakeReadyResponse(program).body
        == "connected, not registered: mcs: registration refused\nno connection: mqtt\n"
           "acsd draining for shutdown\nisConnected=false\n");
}

} // namespace ACS::Acsd::Test
