#include "LinkSubscriptions.hpp"

#include "Catch.hpp"

#include <optional>
#include <string>
#include <vector>

namespace ACS::VDA5050
{

namespace
{

/// Sends what may be sent; the messages are numbered from `first` on.
std::vector<std::string> Send(LinkSubscriptions& subscriptions, int first)
{
    std::vector<std::string> filters;
    while (const std::optional<LinkSubscriptions::Request> next = subscriptions.TakeNextOrNull())
    {
        filters.push_back(next->subscription.topicFilter);
        subscriptions.OnSent(*next, first++);
    }
    return filters;
}

using Filters = std::vector<std::string>;

} // namespace

TEST_CASE("The link waits for the subscriptions that were there when it was connected, some at a time")
{
    LinkSubscriptions subscriptions;
    for (const char* filter : {"a", "b", "c", "d", "e"})
    {
        subscriptions.Add({filter, 1}, false);
    }
    subscriptions.OnAttempt();
    CHECK_FALSE(subscriptions.TakeNextOrNull().has_value());
    subscriptions.OnConnected();
    CHECK(Send(subscriptions, 1) == Filters{"a", "b", "c", "d"});
    subscriptions.Add({"later", 1}, true);
    CHECK_FALSE(subscriptions.OnAnsweredOrNull(99).has_value());
    CHECK(subscriptions.OnAnsweredOrNull(2)->filter == "b");
    CHECK_FALSE(subscriptions.OnAnsweredOrNull(2).has_value());
    CHECK(Send(subscriptions, 5) == Filters{"e"});
    for (const int messageID : {1, 3, 4})
    {
        CHECK_FALSE(subscriptions.OnAnsweredOrNull(messageID)->bLater);
        CHECK_FALSE(subscriptions.IsConfirmed());
    }
    CHECK(Send(subscriptions, 6) == Filters{"later"});
    CHECK_FALSE(subscriptions.IsConfirmed());
    CHECK(subscriptions.OnAnsweredOrNull(5)->filter == "e");
    CHECK(subscriptions.IsConfirmed());
    CHECK(subscriptions.OnAnsweredOrNull(6)->bLater);
}

TEST_CASE("A subscription that was changed or removed is sent as it is now")
{
    LinkSubscriptions subscriptions;
    subscriptions.Add({"a", 0}, false);
    subscriptions.Add({"b", 0}, false);
    subscriptions.Add({"a", 2}, false);
    subscriptions.OnConnected();
    subscriptions.Remove("b");
    const std::optional<LinkSubscriptions::Request> next = subscriptions.TakeNextOrNull();
    REQUIRE(next.has_value());
    CHECK(next->subscription.topicFilter == "a");
    CHECK(next->subscription.qos == 2);
    CHECK_FALSE(subscriptions.TakeNextOrNull().has_value());
    subscriptions.OnAttempt();
    subscriptions.OnConnected();
    CHECK(Send(subscriptions, 1) == Filters{"a"});
}

TEST_CASE("After a refusal nothing more is sent on this connection; the next one begins again")
{
    LinkSubscriptions subscriptions;
    subscriptions.Add({"a", 1}, false);
    subscriptions.OnConnected();
    CHECK(Send(subscriptions, 1) == Filters{"a"});
    subscriptions.Refuse("a");
    subscriptions.Refuse("b");
    CHECK(subscriptions.GetRefused() == "a");
    CHECK(subscriptions.OnAnsweredOrNull(1).has_value());
    CHECK_FALSE(subscriptions.IsConfirmed());
    subscriptions.Add({"c", 1}, true);
    CHECK(Send(subscriptions, 2).empty());
    subscriptions.OnAttempt();
    CHECK(subscriptions.GetRefused().empty());
    subscriptions.OnConnected();
    CHECK(Send(subscriptions, 3) == Filters{"a", "c"});
}

} // namespace ACS::VDA5050
