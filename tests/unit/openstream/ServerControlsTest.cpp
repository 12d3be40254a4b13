#include "ServerControls.hpp"

#include "Catch.hpp"

#include <string>
#include <utility>
#include <variant>
#include <vector>

using namespace ACS::OpenStream; // NOLINT(google-build-using-namespace)

namespace
{

ServerSessionOptions MakeOptions()
{
    ServerSessionOptions options;
    options.maximumControls = 3;
    options.maximumControlBytes = 2 * (sizeof(ApiRequest) + 6) + 2; // two calls of "/arm" with the body {}, and 2 bytes
    return options;
}

const ControlRequest ARM{EApiMethod::Post, "/arm", {}, {}};

std::vector<std::uint64_t> TakeCalls(ServerActions& actions)
{
    std::vector<std::uint64_t> tokens;
    for (const ServerAction& action : std::exchange(actions, {}))
    {
        if (const auto* call = std::get_if<ServerCall>(&action))
        {
            tokens.push_back(call->token);
        }
    }
    return tokens;
}

} // namespace

TEST_CASE("One CONTROL is called at a time")
{
    ServerControls controls(MakeOptions());
    ServerActions actions;
    controls.CallNext(1, actions);
    CHECK(TakeCalls(actions).empty());
    REQUIRE(controls.TryAdd(ARM));
    REQUIRE(controls.TryAdd(ARM));
    controls.CallNext(2, actions);
    controls.CallNext(3, actions);
    CHECK(TakeCalls(actions) == std::vector<std::uint64_t>{2});
    CHECK(controls.IsCall(2));
    CHECK_FALSE(controls.ShouldResumeAfterAnswer());
    controls.CallNext(4, actions);
    CHECK(TakeCalls(actions) == std::vector<std::uint64_t>{4});
    CHECK_FALSE(controls.ShouldResumeAfterAnswer());
    CHECK(controls.IsEmpty());
}

TEST_CASE("CONTROLs without room block the session, are refused after a time, and an answer makes room")
{
    ServerControls controls(MakeOptions());
    REQUIRE(controls.TryAdd(ARM));
    REQUIRE(controls.TryAdd(ARM));
    CHECK_FALSE(controls.IsBlocking());
    REQUIRE(controls.TryAdd(ARM));
    CHECK(controls.IsBlocking());
    CHECK_FALSE(controls.TryAdd(ARM));
    controls.BeginRefusing();
    CHECK_FALSE(controls.IsBlocking());
    CHECK(controls.ShouldResumeAfterAnswer());
    REQUIRE(controls.TryAdd(ARM));
    CHECK(controls.IsBlocking()); // it refuses no more
}

TEST_CASE("STOP control removes what waits, keeps the CONTROL in flight, and works once")
{
    ServerControls controls(MakeOptions());
    ServerActions actions;
    CHECK_FALSE(controls.TryStop(actions));
    REQUIRE(controls.TryAdd(ARM));
    REQUIRE(controls.TryAdd(ARM));
    controls.CallNext(1, actions);
    CHECK(controls.TryStop(actions));
    CHECK_FALSE(controls.TryStop(actions));
    CHECK_FALSE(controls.IsEmpty());
    CHECK_FALSE(controls.ShouldResumeAfterAnswer());
    CHECK(controls.IsEmpty());
    REQUIRE(controls.TryAdd(ARM));
    controls.OnHandshake();
    CHECK_FALSE(controls.TryStop(actions));
}

TEST_CASE("The memory of the parameters counts, not only their text")
{
    ServerSessionOptions options;
    options.maximumControlBytes = 64U * 1024U;
    ServerControls controls(options);
    std::string args = "{\"a0\":0";
    for (int index = 1; index < 2'000; ++index)
    {
        args += ",\"a" + std::to_string(index) + "\":0";
    }
    ControlRequest request = ARM;
    request.args = ACS::Core::JsonText::FromTrusted(args + "}");
    REQUIRE(controls.TryAdd(request));
    CHECK(controls.IsBlocking());
    CHECK(controls.ShouldResumeAfterAnswer());
    REQUIRE(controls.TryAdd(ARM));
    CHECK_FALSE(controls.IsBlocking());
}
