// Uses all of foamVersions.H, with the declarations of version STUB
#include "foamVersions.H"

namespace Foam
{

struct file : regIOobject
{
    const regIOobject* field;
    virtual bool writeObject(MSDD_WRITE_PARAMETERS) const override { return field->writeObject(MSDD_WRITE_ARGUMENTS); }
};

struct bed : thermo
{
    virtual int Cp(const label) const MSDD_OVERRIDE_2106 { return foamTested ? foamApi : 0; }
    virtual int aniAlpha() const MSDD_OVERRIDE_2606 { return *foamDirectedAlpha + foamText().size(); }
};

void use(label& value, const label communicator)
{
    MSDD_MAKE_TABLE(thermo, fvMesh);
    fromMaster(value);
    fromMaster(value, communicator);
    meeting all(newCommunicator());
    value = all.over();
}

} // End namespace Foam
