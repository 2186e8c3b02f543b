// Every way in which editors change files is noticed once.
#include "core/file_watch.h"
#include "support/temp_folder.h"

#include <gmock/gmock.h>

using namespace bounce;
using testing::ElementsAre;
using testing::IsEmpty;

class Watch : public testing::Test {
  protected:
    Watch() {
        folder.write("a", "one");
        folder.write("b", "one");
        watch.watch({folder / "a", folder / "b", folder / "later"});
    }
    TempFolder folder;
    FileWatch watch;
};

TEST_F(Watch, NothingChanged) {
    EXPECT_THAT(watch.poll(), IsEmpty());
    (void)folder.read("a");
    EXPECT_THAT(watch.poll(), IsEmpty());
}

TEST_F(Watch, AnEditInPlaceEvenOfTheSameLength) {
    folder.write("a", "two");
    EXPECT_THAT(watch.poll(), ElementsAre(folder / "a"));
    EXPECT_THAT(watch.poll(), IsEmpty());
}

TEST_F(Watch, ASaveByRenameEvenWithAnOldTimeStamp) {
    auto stamp = std::filesystem::last_write_time(folder / "b");
    folder.write("b.new", "two");
    std::filesystem::last_write_time(folder / "b.new", stamp);
    std::filesystem::rename(folder / "b.new", folder / "b");
    EXPECT_THAT(watch.poll(), ElementsAre(folder / "b"));
    EXPECT_THAT(watch.poll(), IsEmpty());
}

TEST_F(Watch, FilesThatAppearAndVanish) {
    folder.write("later", "here");
    EXPECT_THAT(watch.poll(), ElementsAre(folder / "later"));
    folder.remove("later");
    EXPECT_THAT(watch.poll(), ElementsAre(folder / "later"));
    EXPECT_THAT(watch.poll(), IsEmpty());
    folder.write("later", "again");
    EXPECT_THAT(watch.poll(), ElementsAre(folder / "later"));
}

TEST_F(Watch, AChangeBeforeWatchingAgainIsNotLost) {
    folder.write("a", "changed");
    watch.watch({folder / "a", folder / "later"});
    EXPECT_THAT(watch.poll(), ElementsAre(folder / "a"));
    folder.write("b", "no longer watched");
    EXPECT_THAT(watch.poll(), IsEmpty());
}

TEST_F(Watch, SeveralAtOnce) {
    folder.write("b", "two");
    folder.save_by_rename("a", "two");
    EXPECT_THAT(watch.poll(), ElementsAre(folder / "a", folder / "b"));
}
