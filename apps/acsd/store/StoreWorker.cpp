#include "store/StoreWorker.hpp"

#include <boost/asio/post.hpp>
#include <boost/asio/thread_pool.hpp>

#include <utility>

namespace ACS::Acsd
{

struct StoreWorker::Impl
{
    boost::asio::any_io_executor executor;
    std::unique_ptr<Planning::IPlanStore> store;
    StoredHandler handler;
    CheckedHandler checkedHandler;
    bool bChecking = false;
    boost::asio::thread_pool thread{1};
};

StoreWorker::StoreWorker(
    const boost::asio::any_io_executor& executor,
    std::unique_ptr<Planning::IPlanStore> store,
    StoredHandler handler,
    CheckedHandler checkedHandler)
    : _impl(std::make_shared<Impl>())
{
    _impl->executor = executor;
    _impl->store = std::move(store);
    _impl->handler = std::move(handler);
    _impl->checkedHandler = std::move(checkedHandler);
}

StoreWorker::~StoreWorker()
{
    _impl->handler = nullptr;
    _impl->checkedHandler = nullptr;
    _impl->thread.join();
}

/// Does the work in the thread and handles its result on the executor. The store outlives the work: the destructor waits.
template <typename TWork, typename TAnswer>
void StoreWorker::Do(TWork work, TAnswer answer)
{
    boost::asio::post(_impl->thread, [weak = std::weak_ptr(_impl), &store = *_impl->store, work, answer]() {
        auto result = work(store);
        const std::shared_ptr<Impl> self = weak.lock();
        if (self == nullptr)
        {
            return;
        }
        boost::asio::post(self->executor, [weak, answer, result = std::move(result)]() {
            if (const std::shared_ptr<Impl> owner = weak.lock(); owner != nullptr)
            {
                answer(*owner, result);
            }
        });
    });
}

void StoreWorker::Append(const Planning::StoreBatch& batch)
{
    Do([batch](Planning::IPlanStore& store) { return store.Append(batch); },
       [](Impl& owner, const Core::Result<void>& result) {
           if (owner.handler)
           {
               owner.handler(result);
           }
       });
}

void StoreWorker::CheckAsync()
{
    if (std::exchange(_impl->bChecking, true))
    {
        return;
    }
    Do([](Planning::IPlanStore& store) { return store.Check().map([&store] { return store.CheckLog(); }); },
       [](Impl& owner, const Core::Result<Planning::StoreLog>& result) {
           owner.bChecking = false;
           if (owner.checkedHandler)
           {
               owner.checkedHandler(result);
           }
       });
}

} // namespace ACS::Acsd
