#include "store/StoreWorker.hpp"

#include "Catch.hpp"
#include <acs/plan/EPlanningError.hpp>

#include <boost/asio/executor_work_guard.hpp>
#include <boost/asio/io_context.hpp>

#include <atomic>
#include <future>
#include <thread>

namespace ACS::Testing
{
namespace
{

using namespace Planning; // NOLINT(google-build-using-namespace): a test of that namespace

/// A disk that waits until the test sets its answer.
class SlowStore final : public IPlanStore
{
    std::future<bool> _word;
    std::atomic<std::size_t>& _written;

public:
    SlowStore(std::future<bool> word, std::atomic<std::size_t>& written)
        : _word(std::move(word)),
          _written(written)
    {
    }

    [[nodiscard]] Core::Result<StoredState> Load() override
    {
        return StoredState{};
    }

    [[nodiscard]] Core::Result<void> Append(const StoreBatch& batch) override
    {
        if (!_word.get())
        {
            return Core::Fail(make_error_code(EPlanningError::StoreFailed), "acsd.db", "room", "disk full");
        }
        _written += batch.changes.size();
        return {};
    }

    [[nodiscard]] Core::Result<void> Check() override
    {
        return _word.get() ? Core::Result<void>()
                           : Core::Fail(make_error_code(EPlanningError::StoreFailed), "acsd.db", "the file", "nothing");
    }

    [[nodiscard]] StoreLog CheckLog() override
    {
        return {"acsd.db", 4'096, 1'000'000, {}};
    }
};

} // namespace

TEST_CASE("A batch is stored in another thread, and the handler runs on the executor's thread")
{
    const bool bWorks = GENERATE(true, false);
    boost::asio::io_context context;
    const auto guard = boost::asio::make_work_guard(context);
    std::promise<bool> word;
    std::atomic<std::size_t> written{0};
    std::optional<Core::Result<void>> answer;
    std::thread::id answeredBy;
    Acsd::StoreWorker worker(
        context.get_executor(),
        std::make_unique<SlowStore>(word.get_future(), written),
        [&](const Core::Result<void>& result) {
            answer = result;
            answeredBy = std::this_thread::get_id();
        },
        nullptr);
    worker.Append({{ReportRemoved{1}, ReportRemoved{2}}});
    context.poll();
    CHECK_FALSE(answer.has_value()); // the disk waits for the test, the executor does not
    word.set_value(bWorks);
    while (!answer.has_value())
    {
        REQUIRE(context.run_one_for(std::chrono::seconds(10)) == 1);
    }
    CHECK(answer->has_value() == bWorks);
    CHECK(answeredBy == std::this_thread::get_id());
    CHECK(written == (bWorks ? 2 : 0));
}

TEST_CASE("The destructor of a worker waits for the write under way and calls no handler")
{
    boost::asio::io_context context;
    std::promise<bool> word;
    std::atomic<std::size_t> written{0};
    bool bTold = false;
    {
        Acsd::StoreWorker worker(
            context.get_executor(),
            std::make_unique<SlowStore>(word.get_future(), written),
            [&](const Core::Result<void>&) { bTold = true; },
            [&](const Core::Result<StoreLog>&) { bTold = true; });
        worker.Append({{ReportRemoved{1}}});
        word.set_value(true);
    }
    CHECK(written == 1);
    context.run();
    CHECK_FALSE(bTold);
}

TEST_CASE("A check runs in another thread, one at a time; the handler receives the failure, or the state of the log")
{
    const bool bWorks = GENERATE(true, false);
    boost::asio::io_context context;
    const auto guard = boost::asio::make_work_guard(context);
    std::promise<bool> word;
    std::atomic<std::size_t> written{0};
    std::optional<Core::Result<StoreLog>> checked;
    Acsd::StoreWorker worker(
        context.get_executor(),
        std::make_unique<SlowStore>(word.get_future(), written),
        [](const Core::Result<void>&) { FAIL("nothing was stored"); },
        [&](const Core::Result<StoreLog>& result) { checked = result; });
    worker.CheckAsync();
    worker.CheckAsync(); // the answer is set once: a second check would throw
    context.poll();
    CHECK_FALSE(checked.has_value());
    word.set_value(bWorks);
    while (!checked.has_value())
    {
        REQUIRE(context.run_one_for(std::chrono::seconds(10)) == 1);
    }
    REQUIRE(checked->has_value() == bWorks);
    CHECK((bWorks ? checked->value().path : checked->error().path) == "acsd.db");
}

} // namespace ACS::Testing
