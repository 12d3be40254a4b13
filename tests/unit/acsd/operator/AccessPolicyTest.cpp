#include "operator/AccessPolicy.hpp"

#include "Catch.hpp"

#include <map>
#include <string>
#include <utility>

using namespace ACS; // NOLINT(google-build-using-namespace)
using Acsd::AccessPolicy;
using Acsd::EOperatorRole;
using Acsd::OperatorIdentity;
using EAccess = AccessPolicy::EAccess;
using EProof = OperatorIdentity::EProof;

namespace
{

const Apps::Endpoint REMOTE{"10.0.0.7", 40'000};

const std::vector<Acsd::OperatorToken> TOKENS{
    {EOperatorRole::Viewer, "grafana", Acsd::HashToken("read")},
    {EOperatorRole::Operator, "kim", Acsd::HashToken("write")}};

AccessPolicy::Decision Decide(const AccessPolicy::Options& options, const std::string& method, Apps::HttpSender sender)
{
    Apps::HttpRequest request = *Apps::ParseHttpTarget("/v1/tsc/pause");
    request.method = method;
    request.sender = std::move(sender);
    return AccessPolicy(options).Decide(request);
}

} // namespace

TEST_CASE("Without tokens and certificates every program on this machine is an operator, and no other is served")
{
    for (const char* host : {"127.0.0.1", "127.8.9.1", "::1", "::ffff:127.0.0.1"})
    {
        INFO(host);
        const AccessPolicy::Decision decision = Decide({}, "POST", {{host, 1}});
        CHECK(decision.access == EAccess::Permitted);
        CHECK(decision.identity == OperatorIdentity{EProof::Local, "", EOperatorRole::Operator});
    }
    for (const char* host : {"10.0.0.7", "::ffff:10.0.0.7", "fe80::1", "0.0.0.0", ""})
    {
        INFO(host);
        CHECK(Decide({}, "GET", {{host, 1}}).access == EAccess::Forbidden);
    }
}

TEST_CASE("With tokens each request needs a valid one, also from this machine")
{
    const AccessPolicy::Options options{TOKENS, std::nullopt};
    for (const std::string& authorization :
         {std::string(),
          std::string("Bearer"),
          std::string("Bearer guess"),
          std::string("Bearer writ"),
          std::string("Bearer write x"),
          std::string("Basic write"),
          std::string("write")})
    {
        for (const std::string& host : {REMOTE.host, std::string("127.0.0.1")})
        {
            INFO(authorization << " of " << host);
            const AccessPolicy::Decision decision = Decide(options, "GET", {{host, 1}, authorization});
            CHECK(decision.access == EAccess::Unidentified);
            CHECK_FALSE(decision.identity.has_value());
            CHECK_FALSE(decision.reason.empty());
        }
    }
    CHECK(Decide(options, "GET", {REMOTE, {}, "kim"}).access == EAccess::Unidentified); // certificates are not used
    const AccessPolicy::Decision decision = Decide(options, "POST", {REMOTE, "bearer  write"});
    CHECK(decision.access == EAccess::Permitted);
    CHECK(decision.identity == OperatorIdentity{EProof::Token, "kim", EOperatorRole::Operator});
    // An empty file permits no one.
    CHECK(Decide({std::vector<Acsd::OperatorToken>{}, {}}, "GET", {{"127.0.0.1", 1}}).access == EAccess::Unidentified);
}

TEST_CASE("A viewer may read and sends no other request")
{
    const AccessPolicy::Options options{TOKENS, std::nullopt};
    for (const char* method : {"GET", "HEAD"})
    {
        CHECK(Decide(options, method, {REMOTE, "Bearer read"}).access == EAccess::Permitted);
    }
    for (const char* method : {"POST", "PUT", "DELETE", "OPTIONS", "get", ""})
    {
        INFO(method);
        const AccessPolicy::Decision decision = Decide(options, method, {REMOTE, "Bearer read"});
        CHECK(decision.access == EAccess::Forbidden);
        CHECK(decision.identity == OperatorIdentity{EProof::Token, "grafana", EOperatorRole::Viewer});
        CHECK(decision.reason == "grafana is a viewer and may not send commands.");
    }
}

TEST_CASE("The CN of a client certificate has its role; a token takes precedence, also an invalid one")
{
    const AccessPolicy::Options certificates{
        std::nullopt,
        {{{"kim", EOperatorRole::Operator}, {"grafana", EOperatorRole::Viewer}}}};
    CHECK(Decide(certificates, "POST", {REMOTE, {}, "kim"}).access == EAccess::Permitted);
    CHECK(
        Decide(certificates, "POST", {REMOTE, {}, "kim"}).identity
        == OperatorIdentity{EProof::Certificate, "kim", EOperatorRole::Operator});
    CHECK(Decide(certificates, "POST", {REMOTE, {}, "grafana"}).access == EAccess::Forbidden);
    CHECK(Decide(certificates, "GET", {REMOTE, {}, "lee"}).access == EAccess::Forbidden);
    CHECK_FALSE(Decide(certificates, "GET", {REMOTE, {}, "lee"}).identity.has_value());
    CHECK(Decide(certificates, "GET", {REMOTE}).access == EAccess::Unidentified);
    CHECK(Decide(certificates, "GET", {REMOTE, "Bearer read"}).access == EAccess::Unidentified); // tokens are not used
    CHECK(Decide(certificates, "GET", {{"127.0.0.1", 1}}).access == EAccess::Unidentified);

    const AccessPolicy::Options both{TOKENS, certificates.certificates};
    CHECK(Decide(both, "POST", {REMOTE, {}, "kim"}).access == EAccess::Permitted);
    CHECK(Decide(both, "POST", {REMOTE, "Bearer read", "kim"}).access == EAccess::Forbidden);
    CHECK(Decide(both, "POST", {REMOTE, "Bearer guess", "kim"}).access == EAccess::Unidentified);
}

TEST_CASE("The files of the page are served without identification, and nothing else")
{
    const auto isPublic = [](const std::string& method, const std::string& target) {
        Apps::HttpRequest request = *Apps::ParseHttpTarget(target);
        request.method = method;
        return AccessPolicy::IsPublic(request);
    };
    for (const char* target : {"/", "/?x=1", "/page/app.js", "/page/a/b.css"})
    {
        CAPTURE(target);
        CHECK(isPublic("GET", target));
        CHECK(isPublic("HEAD", target));
        CHECK_FALSE(isPublic("POST", target));
    }
    for (const char* target :
         {"/page", "/pages/x", "/page%2Fx", "//", "//page/x", "/v1/page/x", "/v1/status", "/audit"})
    {
        CAPTURE(target);
        CHECK_FALSE(isPublic("GET", target));
    }
}

TEST_CASE("A session counts as its token; a command with it needs the Origin of the own address")
{
    const AccessPolicy policy({TOKENS, std::map<std::string, EOperatorRole>{{"tool", EOperatorRole::Viewer}}});
    Apps::HttpRequest request = *Apps::ParseHttpTarget("/tsc/pause");
    request.method = "GET";
    request.sender = {REMOTE};
    const auto decide = [&](const char* token) {
        return policy.Decide(request, Acsd::HashToken(token));
    };
    CHECK(decide("write").identity == OperatorIdentity{EProof::Session, "kim", EOperatorRole::Operator});
    CHECK(decide("withdrawn").access == EAccess::Unidentified);
    request.method = "POST";
    CHECK(decide("write").access == EAccess::Forbidden);
    request.headers = {{"Host", "acs:8081"}, {"Origin", "http://evil:8081"}};
    CHECK(decide("write").access == EAccess::Forbidden);
    request.headers = {{"Host", "acs:8081"}, {"Origin", "http://acs:8081"}};
    CHECK(decide("write").access == EAccess::Permitted);
    CHECK(decide("read").access == EAccess::Forbidden);
    request.headers.clear();
    // A token decides before the session, the session before a certificate.
    request.sender.authorization = "Bearer write";
    CHECK(decide("read").identity->proof == EProof::Token);
    CHECK(decide("read").access == EAccess::Permitted);
    request.sender.authorization.clear();
    request.sender.certificateName = "tool";
    CHECK(decide("write").identity->proof == EProof::Session);
    CHECK(decide("withdrawn").identity->proof == EProof::Certificate);
}
