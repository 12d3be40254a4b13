#include "operator/IdempotencyKeys.hpp"

#include "Catch.hpp"
#include "ManualClock.hpp"

#include <algorithm>
#include <chrono>
#include <cstddef>
#include <iterator>
#include <string>
#include <utility>
#include <vector>

using namespace ACS; // NOLINT(google-build-using-namespace)
using Acsd::EOperatorRole;
using Acsd::IdempotencyKeys;
using Acsd::OperatorIdentity;

namespace
{

const OperatorIdentity LEE{OperatorIdentity::EProof::Token, "lee", EOperatorRole::Operator};

struct KeyFixture
{
    Testing::ManualClock clock;
    IdempotencyKeys keys;
    Apps::HttpResponse next{202, "application/json", "{\"message\":\"done\"}\n"};
    int calls = 0;
    std::vector<Planning::CommandReceipt> receipts; ///< Of the commands that were executed.

    IdempotencyKeys::Answer Post(
        const std::string& key,
        const std::string& target = "/v1/tsc/pause",
        const std::string& body = {},
        const OperatorIdentity& identity = LEE)
    {
        Apps::HttpRequest request = *Apps::ParseHttpTarget(target);
        request.method = "POST";
        request.body = body;
        request.headers = {{"idempotency-key", key}};
        return keys.Respond(request, identity, clock.GetNow().steady, [this] {
            ++calls;
            receipts.push_back(keys.MakeReceiptOrNull(next, clock.GetNow().wall).value());
            return next;
        });
    }
};

bool IsReplayed(const IdempotencyKeys::Answer& answer)
{
    const std::pair<std::string, std::string> header{"Idempotent-Replay", "true"};
    return answer.key.bReplay && std::ranges::count(answer.response.headers, header) == 1;
}

} // namespace

TEST_CASE("A repeated command gets the first answer and has no second effect")
{
    KeyFixture fixture;
    const IdempotencyKeys::Answer first = fixture.Post("k1");
    CHECK(first.response.status == 202);
    CHECK_FALSE(IsReplayed(first));
    fixture.next = {409, "application/json", "{\"error\":\"no\"}\n"};
    const IdempotencyKeys::Answer again = fixture.Post("k1");
    CHECK(IsReplayed(again));
    CHECK(again.response.status == 202);
    CHECK(again.response.body == first.response.body);
    CHECK(fixture.calls == 1);
    CHECK(fixture.Post("k2").response.status == 409);
    CHECK(IsReplayed(fixture.Post("k2")));
    CHECK(fixture.calls == 2);
}

TEST_CASE("A key belongs to one request of one name")
{
    KeyFixture fixture;
    CHECK(fixture.Post("k", "/v1/a", "{}").response.status == 202);
    CHECK(fixture.Post("k", "/v1/b", "{}").response.status == 409);
    CHECK(fixture.Post("k", "/v1/a?x=1", "{}").response.status == 409);
    CHECK(fixture.Post("k", "/v1/a", "{ }").response.status == 409);
    CHECK(fixture.calls == 1);
    const OperatorIdentity other{OperatorIdentity::EProof::Token, "kim", EOperatorRole::Operator};
    const OperatorIdentity certificate{OperatorIdentity::EProof::Certificate, "lee", EOperatorRole::Operator};
    CHECK_FALSE(IsReplayed(fixture.Post("k", "/v1/a", "{}", other)));
    CHECK_FALSE(IsReplayed(fixture.Post("k", "/v1/a", "{}", certificate)));
    CHECK(IsReplayed(fixture.Post("k", "/v1/a", "{}")));
}

TEST_CASE(
    "A key has 1 to 64 letters, digits and . _ -; others are answered with 400, and a request without is passed on")
{
    KeyFixture fixture;
    for (const std::string& key :
         {std::string(), std::string("a b"), std::string("a/b"), std::string("\xC3\xA4"), std::string(65, 'x')})
    {
        CAPTURE(key);
        CHECK(fixture.Post(key).response.status == 400);
    }
    CHECK(fixture.calls == 0);
    CHECK(fixture.Post(std::string(64, 'x')).response.status == 202);
    CHECK(fixture.Post("aZ09._-").response.status == 202);
    Apps::HttpRequest request;
    for (int count = 0; count < 2; ++count)
    {
        const auto answer = fixture.keys.Respond(request, LEE, {}, [&fixture] {
            CHECK_FALSE(fixture.keys.MakeReceiptOrNull({}, {}).has_value());
            return Apps::HttpResponse{};
        });
        CHECK(answer.response.status == 200);
        CHECK(answer.key.key.empty());
    }
}

TEST_CASE("Answers are kept 10 minutes, at most 1,000 of them, and none of 500 and above")
{
    KeyFixture fixture;
    fixture.next.status = 503;
    CHECK(fixture.Post("k").response.status == 503);
    fixture.next.status = 202;
    CHECK_FALSE(IsReplayed(fixture.Post("k")));
    fixture.clock.Advance(Planning::CommandReceipt::KEPT - std::chrono::milliseconds(1));
    CHECK(IsReplayed(fixture.Post("k")));
    fixture.clock.Advance(std::chrono::milliseconds(1));
    CHECK_FALSE(IsReplayed(fixture.Post("k")));
    for (std::size_t number = 1; number < Planning::CommandReceipt::MOST_RECEIPTS; ++number)
    {
        CHECK_FALSE(IsReplayed(fixture.Post("n" + std::to_string(number))));
    }
    CHECK(IsReplayed(fixture.Post("k")));
    CHECK_FALSE(IsReplayed(fixture.Post("onemore")));
    CHECK_FALSE(IsReplayed(fixture.Post("k")));
}

TEST_CASE("The key of a command that was not executed is forgotten, and the command is executed when it is repeated")
{
    KeyFixture fixture;
    static_cast<void>(fixture.Post("a"));
    static_cast<void>(fixture.Post("b"));
    fixture.keys.Forget(fixture.receipts.front());
    CHECK(IsReplayed(fixture.Post("b")));
    CHECK_FALSE(IsReplayed(fixture.Post("a")));
    CHECK(fixture.calls == 3);
}

TEST_CASE("The keys of receipts are valid after a restart, for the rest of their 10 minutes")
{
    KeyFixture before;
    CHECK(before.Post("old").response.status == 202);
    before.clock.Advance(std::chrono::minutes(6));
    CHECK(before.Post("k", "/v1/a", "{}").response.status == 202);
    CHECK(IsReplayed(before.Post("k", "/v1/a", "{}")));
    CHECK(before.Post("k", "/v1/b").response.status == 409);
    CHECK(before.receipts.size() == 2);

    KeyFixture after;
    after.clock.Advance(std::chrono::minutes(11));
    const Core::WallTime now = after.clock.GetNow().wall;
    std::vector<Planning::CommandReceipt> receipts{
        {"token lee", "broken", "not JSON", now},
        {"token lee", "broken", "[]", now},
        {"token lee", "broken", "{\"status\":-1}", now}};
    std::ranges::copy(before.receipts, std::back_inserter(receipts));
    after.keys.Restore(receipts, after.clock.GetNow());
    const IdempotencyKeys::Answer kept = after.Post("k", "/v1/a", "{}");
    CHECK(IsReplayed(kept));
    CHECK(kept.response.status == 202);
    CHECK(kept.response.contentType == "application/json");
    CHECK(kept.response.body == "{\"message\":\"done\"}\n");
    CHECK(after.Post("k", "/v1/b").response.status == 409);
    CHECK(after.calls == 0);
    CHECK_FALSE(IsReplayed(after.Post("old")));
    CHECK_FALSE(IsReplayed(after.Post("broken")));
    after.clock.Advance(std::chrono::minutes(5));
    CHECK_FALSE(IsReplayed(after.Post("k", "/v1/a", "{}")));
}

TEST_CASE("A wall clock that was set back keeps the keys of receipts for 10 minutes")
{
    KeyFixture before;
    CHECK(before.Post("k").response.status == 202);
    KeyFixture after;
    after.clock.JumpWall(-std::chrono::hours(1));
    after.keys.Restore(before.receipts, after.clock.GetNow());
    CHECK(IsReplayed(after.Post("k")));
    after.clock.Advance(Planning::CommandReceipt::KEPT);
    CHECK_FALSE(IsReplayed(after.Post("k")));
}
