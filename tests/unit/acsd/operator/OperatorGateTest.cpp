#include "operator/OperatorGate.hpp"

#include "Catch.hpp"
#include "ManualClock.hpp"
#include "RecordingLogSink.hpp"

#include <string>

using namespace ACS; // NOLINT(google-build-using-namespace)
using Acsd::AccessPolicy;
using Acsd::EOperatorRole;

namespace
{

struct GateFixture
{
    Testing::ManualClock clock;
    Testing::RecordingLogSink log;
    Acsd::OperatorGate gate{
        clock,
        Core::Logger(log, "operator"),
        AccessPolicy(
            {{{{EOperatorRole::Viewer, "grafana", Acsd::HashToken("read")},
               {EOperatorRole::Operator, "kim", Acsd::HashToken("write")}}},
             std::nullopt})};
    int commands = 0;

    GateFixture()
    {
        gate.GetRoutes().Add("POST", "/tsc/pause", [this](const auto&, const auto&) {
            ++commands;
            return Apps::HttpResponse{202, "application/json", "{\"message\":\"paused\"}\n"};
        });
    }

    Apps::HttpResponse Post(const std::string& token, const std::string& target = "/tsc/pause")
    {
        Apps::HttpRequest request = *Apps::ParseHttpTarget(target);
        request.method = "POST";
        request.sender = {{"10.0.0.7", 40'000}, token.empty() ? token : "Bearer " + token};
        return gate.Respond(request);
    }
};

} // namespace

TEST_CASE("A request without a valid token is answered with 401 and a challenge, one of a viewer with 403")
{
    GateFixture fixture;
    for (const char* token : {"", "guess"})
    {
        const Apps::HttpResponse response = fixture.Post(token, "/unknown");
        CHECK(response.status == 401);
        CHECK(response.challenge == "Bearer realm=\"acsd\"");
        CHECK(response.body.starts_with("{\"error\":\""));
    }
    const Apps::HttpResponse forbidden = fixture.Post("read");
    CHECK(forbidden.status == 403);
    CHECK(forbidden.challenge.empty());
    CHECK(forbidden.body == "{\"error\":\"grafana is a viewer and may not send commands.\"}\n");
    CHECK(fixture.commands == 0);
    CHECK(fixture.log.Contains(Core::ELogLevel::Warning, "Refused a request to the operator interface"));
    CHECK(fixture.Post("write").status == 202);
    CHECK(fixture.commands == 1);
}

TEST_CASE("A token that was withdrawn is refused from then on")
{
    GateFixture fixture;
    CHECK(fixture.Post("write").status == 202);
    fixture.gate.SetPolicy(AccessPolicy({std::vector<Acsd::OperatorToken>{}, std::nullopt}));
    CHECK(fixture.Post("write").status == 401);
}
