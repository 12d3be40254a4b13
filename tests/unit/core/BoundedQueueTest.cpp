#include "Catch.hpp"
#include <acs/core/BoundedQueue.hpp>

#include <memory>
#include <string>
#include <vector>

using ACS::Core::BoundedQueue;

TEST_CASE("A bounded queue returns its elements in their order")
{
    BoundedQueue<std::string> queue(3);
    CHECK(queue.IsEmpty());
    REQUIRE(queue.TryPush("first"));
    REQUIRE(queue.TryPush("second"));
    REQUIRE(queue.TryPush("third"));
    CHECK(queue.GetSize() == 3);
    CHECK(std::vector<std::string>(queue.begin(), queue.end()) == std::vector<std::string>{"first", "second", "third"});

    REQUIRE(queue.GetFrontOrNull() != nullptr);
    CHECK(*queue.GetFrontOrNull() == "first");
    CHECK(queue.PopFrontOrNull() == "first");
    CHECK(queue.PopFrontOrNull() == "second");
    CHECK(queue.PopFrontOrNull() == "third");
    CHECK(queue.PopFrontOrNull() == std::nullopt);
    CHECK(queue.GetFrontOrNull() == nullptr);
}

TEST_CASE("A full bounded queue refuses an element and leaves it with the caller")
{
    BoundedQueue<std::unique_ptr<int>> queue(1);
    REQUIRE(queue.TryPush(std::make_unique<int>(1)));
    CHECK(queue.IsFull());

    auto second = std::make_unique<int>(2);
    CHECK_FALSE(queue.TryPush(std::move(second)));
    REQUIRE(second != nullptr); // NOLINT(bugprone-use-after-move): that it was not moved is the rule
    CHECK(queue.GetSize() == 1);

    CHECK(*queue.PopFrontOrNull().value() == 1);
    CHECK(queue.TryPush(std::move(second)));
}

TEST_CASE("A bounded queue without capacity accepts no element")
{
    BoundedQueue<int> queue(0);
    CHECK(queue.IsFull());
    CHECK_FALSE(queue.TryPush(1));
}

TEST_CASE("Outdated elements can be removed from the middle of a bounded queue")
{
    BoundedQueue<int> queue(4);
    for (const int value : {1, 2, 3, 4})
    {
        REQUIRE(queue.TryPush(value));
    }
    const auto isEven = [](int value) {
        return value % 2 == 0;
    };
    CHECK(queue.EraseIf(isEven) == 2);
    CHECK(std::vector<int>(queue.begin(), queue.end()) == std::vector<int>{1, 3});
    CHECK_FALSE(queue.IsFull());
    queue.Clear();
    CHECK(queue.IsEmpty());
    CHECK(queue.GetCapacity() == 4);
}
