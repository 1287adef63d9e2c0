#include <gtest/gtest.h>
#include <vtkCompositeDataIterator.h>
#include <vtkDataArray.h>
#include <vtkGLTFReader.h>
#include <vtkImageData.h>
#include <vtkMultiBlockDataSet.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>
#include <vtkSmartPointer.h>

#include "anatomy/parametric/parametric_patient.h"
#include "anatomy/patient/patient_file.h"
#include "tests/support/files.h"

/// Patient files as another program opens them: VTK's glTF reader, which shares nothing with ours.
namespace palpa::anatomy {
namespace {

Patient reference() {
  return buildPatient(drawParameters(
      readPopulation(PALPA_SOURCE_DIR "/assets/patients/reference.json"), Side::right, 0));
}

std::vector<vtkSmartPointer<vtkPolyData>> surfacesOf(const std::string& file) {
  vtkNew<vtkGLTFReader> reader;
  reader->SetFileName(file.c_str());
  reader->Update();
  std::vector<vtkSmartPointer<vtkPolyData>> surfaces;
  vtkSmartPointer<vtkCompositeDataIterator> leaves;
  leaves.TakeReference(reader->GetOutput()->NewIterator());
  for (leaves->InitTraversal(); !leaves->IsDoneWithTraversal(); leaves->GoToNextItem())
    if (auto* surface = vtkPolyData::SafeDownCast(leaves->GetCurrentDataObject()))
      surfaces.push_back(surface);
  return surfaces;
}

TEST(PatientElsewhere, VtkSeesTheSamePointsInMetresWithYUp) {
  const Patient patient = reference();
  const std::string file = (test::freshFolder("patient_exchange", "vtk") / "p.glb").string();
  writePatient(patient, file);
  const auto surfaces = surfacesOf(file);
  ASSERT_EQ(surfaces.size(), patient.organs.size());
  for (std::size_t i = 0; i < surfaces.size(); ++i) {
    const TriangleMesh& mesh = patient.organs[i].mesh;
    EXPECT_EQ(surfaces[i]->GetNumberOfPoints(), static_cast<vtkIdType>(mesh.points.size()))
        << patient.organs[i].id;
    EXPECT_EQ(surfaces[i]->GetNumberOfCells(), static_cast<vtkIdType>(mesh.triangles.size()))
        << patient.organs[i].id;
    Eigen::AlignedBox3d box;
    for (const Vec3& p : mesh.points)
      box.extend(Vec3(p.x(), p.z(), -p.y()));  // left, up, toward the viewer
    double bounds[6];
    surfaces[i]->GetBounds(bounds);
    for (int k = 0; k < 3; ++k) {
      EXPECT_NEAR(bounds[2 * k], box.min()[k], 1e-6) << patient.organs[i].id;  // m: floats
      EXPECT_NEAR(bounds[2 * k + 1], box.max()[k], 1e-6) << patient.organs[i].id;
    }
  }
}

TEST(PatientElsewhere, VtkFindsThePictureOnTheSkin) {
  const Patient patient = reference();
  const std::string file =
      (test::freshFolder("patient_exchange", "vtk_picture") / "p.glb").string();
  writePatient(patient, file);
  vtkNew<vtkGLTFReader> reader;
  reader->SetFileName(file.c_str());
  reader->Update();
  ASSERT_EQ(reader->GetNumberOfTextures(), 1);
  const auto picture = reader->GetGLTFTexture(0);
  ASSERT_TRUE(picture.Image);
  int size[3];
  picture.Image->GetDimensions(size);
  const RgbPicture& written = patient.organ(Organ::skin).texture;
  EXPECT_EQ(size[0], written.width);
  EXPECT_EQ(size[1], written.height);
  const auto surfaces = surfacesOf(file);
  vtkDataArray* coordinates = surfaces.at(0)->GetPointData()->GetTCoords();
  ASSERT_TRUE(coordinates);
  const auto& uvs = patient.organs[0].mesh.uvs;
  ASSERT_EQ(coordinates->GetNumberOfTuples(), static_cast<vtkIdType>(uvs.size()));
  for (std::size_t i = 0; i < uvs.size(); i += 100)
    EXPECT_EQ(static_cast<float>(coordinates->GetComponent(static_cast<vtkIdType>(i), 0)),
              uvs[i][0]);
}

}  // namespace
}  // namespace palpa::anatomy
