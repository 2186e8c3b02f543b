// Which files are scenes is told by one table.
#include "scene/scene_formats.h"
#include "support/errors.h"

#include <gmock/gmock.h>

using namespace bounce;
using testing::HasSubstr;

TEST(SceneFormats, AreFoundByTheirEndingInAnyCase) {
    for (const char* path : {"a.gltf", "b/a.GLB", "a.b.Gltf"})
        EXPECT_TRUE(scene_format_of(path)) << path;
    for (const char* path : {"a", "a.gltf.json", "gltf", ".gltf", "a.obj"})
        EXPECT_FALSE(scene_format_of(path)) << path;
}

TEST(SceneFormats, AnotherEndingIsToldWithThoseThatAreRead) {
    EXPECT_THAT(error_of([] { load_scene("teapot.obj"); }),
                HasSubstr("teapot.obj: not a scene: expected a file that ends in .gltf, .glb"));
}
