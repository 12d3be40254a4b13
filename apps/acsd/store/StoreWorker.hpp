#pragma once

#include <acs/core/Result.hpp>
#include <acs/plan/IPlanStore.hpp>

#include <boost/asio/any_io_executor.hpp>

#include <functional>
#include <memory>

namespace ACS::Acsd
{

/// A store in a thread of its own: a disk takes milliseconds, in which acsd reads what comes in. Called and answered on the
/// executor's thread.
class StoreWorker final
{
public:
    using StoredHandler = std::function<void(const Core::Result<void>& result)>;
    using LostHandler = std::function<void(const Core::Error& error)>;

private:
    struct Impl;

    std::shared_ptr<Impl> _impl;

public:
    /// The second handler is called for each check that has failed.
    StoreWorker(
        const boost::asio::any_io_executor& executor,
        std::unique_ptr<Planning::IPlanStore> store,
        StoredHandler handler,
        LostHandler lostHandler);
    StoreWorker(const StoreWorker&) = delete;
    StoreWorker& operator=(const StoreWorker&) = delete;

    /// Waits until what was begun is on disk; no handler is called any more.
    ~StoreWorker();

    /// One batch after the other, each answered by one call of the handler, never from within.
    void Append(const Planning::StoreBatch& batch);

    /// Has the store look whether what it holds will be found again; nothing while the check before is not answered.
    void CheckAsync();

private:
    template <typename TWork, typename TAnswer>
    void Do(TWork work, TAnswer answer);
};

} // namespace ACS::Acsd
